// The window's keys, shown over the picture.
#pragma once

namespace shoal::app {

// `title` and rows of two texts, ended by a row of nulls. False: the user closed it.
struct HelpRow {
    const char* keys;
    const char* what;
};
bool showHelp(const char* title, const HelpRow* rows);

extern const HelpRow windowHelp[];  // of a scene's window

}  // namespace shoal::app
