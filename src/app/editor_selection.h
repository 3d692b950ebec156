// The numbers of what is selected, to be read and changed.
#pragma once

namespace shoal::app {

struct Editor;

void drawSelection(Editor& editor);

}  // namespace shoal::app
