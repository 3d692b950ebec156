// The arrays of a subsystem, made from its table and found by their names, and its passes over them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "gpu/array_table.h"
#include "gpu/buffer.h"
#include "gpu/framebuffer.h"
#include "gpu/program.h"
#include "gpu/texture.h"

namespace shoal::gpu {

// A storage buffer that samplers read as well.
struct Array {
    Buffer buffer;
    BufferTexture texture;

    Array() = default;
    // `data`: of so many texels, or null.
    Array(Context& context, size_t texels, Texel texel, const char* label, const void* data = nullptr);
};

// How many elements there are of what.
struct ArraySizes {
    std::map<std::string, size_t, std::less<>> counts;
    size_t list = 0;  // entries of a list
    int rowBits = 0;  // textures have rows of 2^rowBits texels
};

// A program is given what it declares, by name: a sampler `places` reads the array `places`, and a storage
// block `Places` holds it.
class Arrays {
  public:
    // Makes the rows that the scene needs. `label`: goes before their names. Borrows the table. Error: out of
    // memory.
    Arrays(Context& context, const ArrayTable& table, const ArraySizes& sizes, const std::string& label);

    // Makes an array whose content the caller has, of so many values.
    void give(const std::string& name, const void* data, size_t values);
    // These write the first values of an array that has one an element, and all values of one element, and
    // read the latter.
    void write(const std::string& name, Traffic::Kind kind, const void* data, size_t values);
    void writeElement(const std::string& name, Traffic::Kind kind, size_t element, const void* data);
    void readElement(const std::string& name, Traffic::Kind kind, size_t element, void* data) const;
    // Another owner's, for as long as this is used.
    void lend(const std::string& name, const Texture& texture) { entryOf(name).lent = &texture; }
    // `name` is also known as `other`.
    void alias(const std::string& other, const std::string& name) { aliases_[other] = name; }
    // Contents change places: what one was the other is.
    void swap(const std::string& a, const std::string& b);
    // The first is what the last was, and the others what was before them.
    void rotate(const std::vector<std::string>& names);

    bool has(const std::string& name) const;
    Buffer& buffer(const std::string& name) { return entryOf(name).array.buffer; }
    const Buffer& buffer(const std::string& name) const { return entryOf(name).array.buffer; }
    const BufferTexture& view(const std::string& name) const { return entryOf(name).array.texture; }
    Texture& texture(const std::string& name) { return entryOf(name).texture; }
    const Texture& texture(const std::string& name) const { return entryOf(name).texture; }

    // The options of a pass over them, "<file>.pass.glsl" below Context::shaders().
    ProgramOptions passOptions(const std::string& file, const std::string& label) const;
    // Uses a program and gives it all arrays that it declares. What it declares beside them is for the caller
    // to give.
    const Program& use(const Program& program) const;
    // Runs a program in use over elements of shaders/state/lanes.glsl: a dispatch, after a barrier where it
    // reads what others wrote or writes what they read; in fragments a draw of the rows that have them, into
    // what it writes, and of lists into their entries from `firstEntry` on.
    void run(const Program& program, int firstNumber, int numbers, int firstEntry = 0);
    // So many workgroups, or as many as three words of a record say.
    void runGroups(const Program& program, int groups);
    void runIndirect(const Program& program, const std::string& record, size_t offset);
    // Before what reads or writes, not through run(), what dispatches have written, and after it.
    void settle();
    int dispatches() const { return dispatches_; }  // and draws, so far
    // Of a list, how many entries a program of fragments writes at once.
    int entriesADraw(const Program& program) const;
    size_t bytes() const;

  private:
    struct Entry {
        const ArrayRow* row = nullptr;
        Array array;
        Texture texture;
        const Texture* lent = nullptr;
    };
    // What of them a program declares, found once.
    struct Uses {
        struct Use {
            const std::string* name;
            const Entry* entry;
            bool isRead;
        };
        std::vector<Use> samplers, blocks;
    };
    const Uses& usesOf(const Program& program) const;
    // A contract: it is in the table.
    const Entry& entryOf(const std::string& name) const;
    Entry& entryOf(const std::string& name) { return const_cast<Entry&>(std::as_const(*this).entryOf(name)); }
    const Entry* find(std::string_view name) const;
    bool isList(const std::string& name) const;
    std::vector<ColorTarget> targets(const Program& program, int firstEntry) const;
    void order(const Program& program);
    void makeBuffer(Entry& entry, size_t values, const void* data);
    void makeTexture(Entry& entry, size_t elements, const void* data);

    Context* context_;
    const ArrayTable* table_;
    ArraySizes sizes_;
    std::string label_;
    std::map<std::string, Entry, std::less<>> arrays_;
    std::map<std::string, std::string, std::less<>> aliases_;
    Framebuffers framebuffers_;
    mutable std::map<GLuint, Uses> uses_;  // by program
    std::vector<GLuint> written_, read_;   // buffers, since the last barrier
    int dispatches_ = 0;
};

}  // namespace shoal::gpu
