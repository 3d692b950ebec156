// A glTF file (.gltf, .glb): its JSON, and the numbers and bytes that this names. For read_gltf.cpp and
// gltf_materials.cpp alone.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "core/json.h"
#include "geometry/model_reader.h"

namespace shoal {

// An accessor gives elements of 1 to 4 or 16 numbers each, which lie here one after another. Normalised
// integers are fractions.
struct GltfArray {
    size_t count = 0, components = 0;
    std::vector<double> numbers;

    // The element, or as much of it as it has; the rest is `fallback`.
    glm::dvec4 vector(size_t element, glm::dvec4 fallback = {0, 0, 0, 1}) const {
        for (size_t c = 0; c < std::min(components, size_t{4}); ++c)
            fallback[int(c)] = numbers[element * components + c];
        return fallback;
    }
    glm::dmat4 matrix(size_t element) const;  // of 16 components, or of the first 16 of `numbers`
};

// All errors are located at what is wrong in the JSON.
class GltfFile {
  public:
    // Error: no glTF 2.
    explicit GltfFile(const ModelFile& model);

    JsonReader root() const { return {json_, name_}; }
    // One of the lists at the root, such as "nodes".
    size_t count(const char* list) const;
    JsonReader item(const char* list, int index) const;
    // The number of an item of `list` that a key gives; -1: the key is absent. Error: there is none such.
    int index(JsonReader& from, const std::string& key, const char* list) const;

    // Error: out of its buffer, or of none of these numbers of components.
    const GltfArray& array(int accessor, std::initializer_list<size_t> components);
    // The bytes of a view of a buffer, decompressed.
    std::span<const uint8_t> bytes(int view) { return viewOf(view).bytes; }
    // Reads what a URI names: a file beside the model, or itself. Error: cannot be read, `where`.
    std::string fetch(const std::string& uri, const Location& where) const;

  private:
    struct View {
        std::span<const uint8_t> bytes;
        size_t stride = 0;  // 0: the elements lie side by side
        std::vector<uint8_t> own;
    };
    struct Elements;

    void openBinary(const std::string& bytes);
    std::span<const uint8_t> bufferOf(int buffer);
    const View& viewOf(int view);
    std::vector<uint8_t> decompressed(JsonReader& from);
    // Bytes of a buffer that an object names by "buffer", "byteOffset" and "byteLength".
    std::span<const uint8_t> rangeOf(JsonReader& from);
    std::vector<double> read(int view, JsonReader& from, const Elements& kind, size_t count);
    void readSparse(JsonReader& from, const Elements& kind, GltfArray& out);

    std::string name_;
    std::function<void(uint64_t)> opened_;
    JsonValue json_;
    std::optional<std::string> binary_;  // the second chunk of a .glb
    std::map<int, std::string> buffers_;
    std::map<int, View> views_;
    std::map<int, GltfArray> arrays_;
};

// An extension of an object; nothing: it has none of this name.
std::optional<JsonReader> gltfExtension(JsonReader& object, const char* name);
// "a%20b" is "a b".
std::string percentDecoded(const std::string& uri);

}  // namespace shoal
