// The arrays of a subsystem by the names that shaders know them by.
#pragma once

#include <map>
#include <string>

#include "gpu/buffer.h"
#include "gpu/program.h"
#include "gpu/arrays.h"
#include "gpu/texture.h"

namespace shoal::gpu {

// A sampler `places` reads the array `places`, and a storage block `Places` holds it. Borrows what is added:
// its content may be exchanged, but it stays where it is. What is still empty when a program is bound is not
// there for it.
class NamedArrays {
  public:
    void add(const std::string& name, const Array& array) { arrays_[name].array = &array; }
    void add(const std::string& name, const Buffer& buffer) { arrays_[name].buffer = &buffer; }
    void add(const std::string& name, const Texture& texture) { arrays_[name].texture = &texture; }

    // Gives a program in use all of them that it declares. What it declares beside them is for the caller to
    // give.
    void bind(const Program& program) const;
    size_t bytes() const;

  private:
    struct Entry {
        const Array* array = nullptr;
        const Buffer* buffer = nullptr;
        const Texture* texture = nullptr;
    };
    std::map<std::string, Entry, std::less<>> arrays_;
};

}  // namespace shoal::gpu
