// Models read from their text or bytes.
#pragma once

#include <string>

#include "geometry/mesh.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/scratch.h"

namespace shoal::test {

// The mesh of a file of that name, such as m.obj, in a folder of its own.
inline Mesh modelOf(const std::string& name, const std::string& bytes, bool lenient = false) {
    const Scratch scratch;
    return loadMesh(scratch.write(name, bytes), lenient);
}

// Why it is refused, in one line from its name on; empty where it is not.
inline std::string refusalOf(const std::string& name, const std::string& bytes) {
    const Scratch scratch;
    const std::string file = scratch.write(name, bytes), message = messageOf([&] { loadMesh(file); });
    if (message.empty()) return {};
    REQUIRE(message.starts_with(file + ":"));
    CHECK(message.find('\n') == std::string::npos);
    return name + message.substr(file.size());
}

}  // namespace shoal::test
