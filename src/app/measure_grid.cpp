// `shoal measure --report`: the report's own scenes, one file each, then pictures and tables of all.
#include "app/measure.h"

namespace shoal::app {

int measureReport(const Options&) {
    throw Error("--report: not there yet");
}

}  // namespace shoal::app
