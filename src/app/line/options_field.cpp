#include "app/line/cli.h"
#include "app/line/commands.h"

#include "geometry/distance_field.h"

namespace shoal::app {

// Reads an axis and a position on it, such as y=0.5.
static void readSlice(const std::string& text, Options& options) {
    const size_t axis = text.empty() ? std::string::npos : std::string("xyz").find(text[0]);
    double position = 0;
    const bool placed = text.size() > 1;
    if (axis == std::string::npos || (placed && (text[1] != '=' || !isAll(text.substr(2), position))))
        throw Error(concat("expected x, y or z and a position such as y=0.5, found \"", text, "\""));
    options.field.sliceAxis = int(axis);
    if (placed) options.field.slicePosition = position;
}

void addField(CLI::App& command, Options& options) {
    command.add_option("file", options.files, "Scene, by its file or name, or a model of any format")
        ->required()
        ->expected(1)
        ->type_name("SCENE");
    const auto length = [&](const char* option, std::optional<double>& value, const char* what) {
        return addNumber(command, option, value, what, "a length above 0 m",
                         [](double m) { return m > 0 && m < 1e15; });
    };
    addWhole(command, "--resolution", options.field.resolution,
             concat("Cells along the model's longest side (default ", defaultResolution, ")"),
             leastResolution, mostResolution);
    length("--error", options.field.error,
           "Instead: refine until no point near the surface is off by more, m");
    length("--shell", options.field.shell, "Thickness of a model that is not closed, m (default two cells)");
    addNumber(command, "--thickness", options.field.thickness,
              "What vertices keep off the surface, m (default 0.002)", "a length of at least 0 m",
              [](double m) { return m >= 0; });
    addFile(command, "--capture", options.capture, "Draw a slice into this file (.png)")
        ->check(endsIn({".png"}));
    addRead(command, "--slice", "Its plane, such as y=0.5 (default z, through the middle)",
            [&options](const std::string& text) { readSlice(text, options); });
    addSize(command, options, "Largest size of the picture in pixels");
    command.add_option("--only", options.only, "Of a scene: fields with this in their name");
    command.add_flag("--json", options.json, "Report as JSON on standard output");
    needs(command, "--slice", "--capture");
    excludes(command, "--resolution", {"--error"});
}

}  // namespace shoal::app
