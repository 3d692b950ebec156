#include "core/file_format.h"

namespace shoal {

void needFormat(JsonReader& root, const std::string& expected) {
    std::string format;
    root.need("format", format);
    if (format == expected) return;
    const size_t number = expected.rfind('-') + 1;
    const bool kin = format.compare(0, number, expected, 0, number) == 0 && format.size() > number &&
                     format.find_first_not_of("0123456789", number) == std::string::npos;
    throw Error(root.at("format"), concat("expected the format \"", expected, "\", found \"", format, "\"",
                                          kin ? ": the file is of a newer version of Shoal" : ""));
}

}  // namespace shoal
