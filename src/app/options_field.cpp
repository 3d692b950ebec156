#include "app/cli.h"
#include "app/commands.h"

#include "core/file.h"
#include "geometry/distance_field.h"

namespace shoal::app {

void addField(CLI::App& command, Options& options, std::string& slice, std::string& size) {
    command.add_option("file", options.files, "Scene, by its file or name, or a model of any format")
        ->required()
        ->expected(1)
        ->type_name("SCENE");
    const auto length = [&](const char* option, std::optional<double>& value, const char* what) {
        addNumber(command, option, value, what, "a length in m");
    };
    command
        .add_option("--resolution", options.field.resolution,
                    concat("Cells along the model's longest side (default ", defaultResolution, ")"))
        ->check(kindOf(isAll<int>, "a whole number"));
    length("--error", options.field.error,
           "Instead: refine until no point near the surface is off by more, m");
    length("--shell", options.field.shell, "Thickness of a model that is not closed, m (default two cells)");
    length("--thickness", options.field.thickness, "What vertices keep off the surface, m (default 0.002)");
    addFile(command, "--capture", options.capture, "Draw a slice into this file (.png)");
    command.add_option("--slice", slice, "Its plane, such as y=0.5 (default z, through the middle)");
    command.add_option("--size", size, "Largest size of the picture in pixels")
        ->type_name("WxH")
        ->capture_default_str();
    command.add_option("--only", options.only, "Of a scene: fields with this in their name");
    command.add_flag("--json", options.json, "Report as JSON on standard output");
    needs(command, "--slice", "--capture");
    excludes(command, "--resolution", {"--error"});
}

// x, y or z, and where.
static void readSlice(const std::string& text, Options& options) {
    if (text.empty()) return;
    const size_t axis = std::string("xyz").find(text[0]);
    const std::string position = text.size() > 2 ? text.substr(2) : "";
    if (axis == std::string::npos || (text.size() > 1 && (text[1] != '=' || !isAll<double>(position))))
        throw Error(concat("--slice: expected x, y or z and a position such as y=0.5, found \"", text, "\""));
    options.field.sliceAxis = int(axis);
    if (!position.empty()) options.field.slicePosition = std::stod(position);
}

void checkField(Options& options, const std::string& slice) {
    if (options.command != fieldCommand) return;
    readSlice(slice, options);
    const Options::Field& field = options.field;
    if (field.resolution && (*field.resolution < leastResolution || *field.resolution > mostResolution))
        throw Error(concat("--resolution: expected ", leastResolution, " to ", mostResolution, ", found ",
                           *field.resolution));
    const auto above = [](const char* option, const std::optional<double>& value, bool zero) {
        if (value && !(zero ? *value >= 0 : *value > 0 && *value < 1e15))
            throw Error(concat(option, ": expected a length ", zero ? "of at least" : "above", " 0 m, found ",
                               *value));
    };
    above("--error", field.error, false);
    above("--shell", field.shell, false);
    above("--thickness", field.thickness, true);
    if (!options.capture.empty() && lowerExtension(options.capture) != ".png")
        throw Error(concat("--capture: expected a name ending in .png, found \"", options.capture, "\""));
}

}  // namespace shoal::app
