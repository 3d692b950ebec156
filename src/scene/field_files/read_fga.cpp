#include "scene/field_files/field_file.h"

namespace shoal {

namespace {

double need(NumberScanner& numbers, const std::string& what) {
    double value = 0;
    if (!numbers.next(value)) throw Error(numbers.here(), "expected " + what + ", found the end of the file");
    return value;
}

FileGrid readHeader(NumberScanner& numbers) {
    FileGrid grid;
    glm::dvec3 resolution(1);
    for (int i = 0; i < 3; ++i) {
        resolution[i] = need(numbers, concat("the resolution along ", axisNames[i]));
        countCells(resolution, numbers.here());
    }
    grid.resolution = glm::ivec3(resolution);
    for (int i = 0; i < 3; ++i)
        grid.low[i] = need(numbers, concat("the low bound along ", axisNames[i]));
    for (int i = 0; i < 3; ++i) {
        grid.high[i] = need(numbers, concat("the high bound along ", axisNames[i]));
        if (!(grid.low[i] < grid.high[i]))
            throw Error(numbers.here(), "expected the high bound along ", axisNames[i],
                        " above the low one (", grid.low[i], "), found ", grid.high[i]);
    }
    return grid;
}

}  // namespace

FileGrid parseFga(const std::string& text, const std::string& file) {
    NumberScanner numbers(text, file);
    FileGrid grid = readHeader(numbers);
    const size_t expected = 3 * countCells(glm::dvec3(grid.resolution), numbers.here());
    // A number and its separator take two characters at least: a short file cannot make us reserve much.
    if (text.size() / 2 + 1 < expected) {
        size_t found = 0;
        for (double ignored; numbers.next(ignored);)
            ++found;
        throw Error(numbers.here(), "expected ", expected, " values, found ", found);
    }
    grid.values = takeVelocities(numbers, expected / 3);
    if (double extra = 0; numbers.next(extra)) {
        const Location where = numbers.here();
        size_t found = expected + 1;
        while (numbers.next(extra))
            ++found;
        throw Error(where, "expected ", expected, " values, found ", found);
    }
    return grid;
}

}  // namespace shoal
