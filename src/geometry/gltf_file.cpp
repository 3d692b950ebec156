#include "geometry/gltf_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>

#include <meshoptimizer.h>
#include <glm/gtc/type_ptr.hpp>

#include "core/error.h"
#include "core/file.h"

namespace shoal {

namespace {

constexpr double mostBytes = 4e9;  // of anything; more than memory allows is refused by the child's limits

uint32_t word(const std::string& bytes, size_t offset) {
    uint32_t out = 0;
    std::memcpy(&out, bytes.data() + offset, 4);
    return out;
}

std::string fromBase64(const std::string& text, size_t from, const Location& where) {
    static const std::array<int8_t, 256> digits = [] {
        std::array<int8_t, 256> out;
        out.fill(-1);
        const char all[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        for (int8_t i = 0; i < 64; ++i)
            out[uint8_t(all[i])] = i;
        return out;
    }();
    std::string out;
    out.reserve((text.size() - from) / 4 * 3);
    uint32_t bits = 0;
    int held = 0;
    for (; from < text.size() && text[from] != '='; ++from) {
        const int8_t digit = digits[uint8_t(text[from])];
        if (digit < 0) throw Error(where, "holds what is not base64");
        bits = bits << 6 | uint32_t(digit);
        if ((held += 6) < 8) continue;
        held -= 8;
        out += char(bits >> held & 255);
    }
    return out;
}

enum ComponentType { int8 = 5120, uint8 = 5121, int16 = 5122, uint16 = 5123, uint32 = 5125, float32 = 5126 };

// A whole number that a key gives, at most `most`; 0 without it.
size_t whole(JsonReader& from, const char* key, double most) {
    double out = 0;
    from.get(key, out, Range::between(0, most));
    if (out != std::floor(out)) throw Error(from.locate(key), "expected a whole number, found ", out);
    return size_t(out);
}

template <typename T>
double numberAt(const uint8_t* bytes) {
    T out;
    std::memcpy(&out, bytes, sizeof out);
    return double(out);
}

}  // namespace

// How the elements of an accessor lie.
struct GltfFile::Elements {
    int type = 0;
    size_t bytes = 0;  // of a component
    size_t components = 1;
    bool normalized = false;

    Elements() = default;
    Elements(int componentType, const Location& where) : type(componentType) {
        bytes = type == int8 || type == uint8       ? 1
                : type == int16 || type == uint16   ? 2
                : type == uint32 || type == float32 ? 4
                                                    : 0;
        if (bytes == 0) throw Error(where, "expected a type of component of glTF, found ", type);
    }
    double number(const uint8_t* data) const {
        switch (type) {
        case int8:
            return normalized ? std::max(numberAt<int8_t>(data) / 127, -1.0) : numberAt<int8_t>(data);
        case uint8:
            return numberAt<uint8_t>(data) / (normalized ? 255 : 1);
        case int16:
            return normalized ? std::max(numberAt<int16_t>(data) / 32767, -1.0) : numberAt<int16_t>(data);
        case uint16:
            return numberAt<uint16_t>(data) / (normalized ? 65535 : 1);
        case uint32:
            return numberAt<uint32_t>(data) / (normalized ? 4294967295.0 : 1);
        default:
            return double(numberAt<float>(data));
        }
    }
};

std::optional<JsonReader> gltfExtension(JsonReader& object, const char* name) {
    std::optional<JsonReader> all = object.object("extensions");
    return all ? all->object(name) : std::nullopt;
}

std::string percentDecoded(const std::string& uri) {
    std::string out;
    for (size_t i = 0; i < uri.size(); ++i) {
        const auto isHex = [&](size_t index) {
            return index < uri.size() && std::isxdigit(uint8_t(uri[index]));
        };
        if (uri[i] == '%' && isHex(i + 1) && isHex(i + 2)) {
            out += char(std::stoi(uri.substr(i + 1, 2), nullptr, 16));
            i += 2;
        } else {
            out += uri[i];
        }
    }
    return out;
}

glm::dmat4 GltfArray::matrix(size_t element) const {
    return glm::make_mat4(numbers.data() + element * 16);
}

GltfFile::GltfFile(const ModelFile& model) : name_(model.name), opened_(model.opened) {
    const std::string bytes = readFile(name_);
    opened_(bytes.size());
    if (bytes.starts_with("glTF"))
        openBinary(bytes);
    else
        json_ = parseJson(bytes, name_);
    JsonReader all = root();
    std::optional<JsonReader> asset = all.object("asset");
    if (!asset) throw Error(all.here(), "has no \"asset\": it is no glTF 2");
    std::string version, least = "2.0";
    asset->need("version", version);
    asset->get("minVersion", least);
    if (!version.starts_with("2.") || least != "2.0")
        throw Error(asset->locate("version"), "is of version ", least == "2.0" ? version : least,
                    " of glTF, expected 2.0");
}

// A head of 12 bytes, then chunks: their length, kind and bytes.
void GltfFile::openBinary(const std::string& bytes) {
    const Location location{name_};
    if (bytes.size() < 20) throw Error(location, "ends within its head");
    if (word(bytes, 4) != 2) throw Error(location, "is of version ", word(bytes, 4), " of glTF, expected 2");
    const size_t end = word(bytes, 8);
    if (end > bytes.size())
        throw Error(location, "is cut off: its head tells of ", end, " bytes, it has ", bytes.size());
    for (size_t offset = 12, chunk = 0; offset + 8 <= end; ++chunk) {
        const size_t length = word(bytes, offset);
        const std::string kind = bytes.substr(offset + 4, 4);
        if (length > end - offset - 8) throw Error(location, "has a chunk that ends after the file");
        if ((chunk == 0) != (kind == "JSON")) throw Error(location, "does not begin with a chunk of JSON");
        if (chunk == 0) json_ = parseJson(bytes.substr(offset + 8, length), name_);
        if (kind == std::string("BIN\0", 4) && !binary_) binary_ = bytes.substr(offset + 8, length);
        offset += 8 + length;
    }
}

size_t GltfFile::count(const char* list) const {
    const JsonValue* items = json_.find(list);
    if (!items) return 0;
    if (items->kind != JsonValue::Kind::array)
        throw Error(root().locate(list), "expected an array, found ", shoal::name(items->kind));
    return items->items.size();
}

JsonReader GltfFile::item(const char* list, int index) const {
    return {json_.find(list)->items[size_t(index)], name_, concat("$.", list, "[", index, "]")};
}

int GltfFile::index(JsonReader& from, const std::string& key, const char* list) const {
    int out = -1;
    const size_t all = count(list);
    if (from.has(key) && all == 0) throw Error(from.locate(key), "the file has no ", list);
    from.get(key, out, Range::between(0, double(all) - 1));
    return out;
}

std::string GltfFile::fetch(const std::string& uri, const Location& where) const {
    constexpr const char* embedded = ";base64,";
    if (uri.starts_with("data:")) {
        const size_t start = uri.substr(0, 1000).find(embedded);
        if (start == std::string::npos) throw Error(where, "expected data in base64");
        return fromBase64(uri, start + std::strlen(embedded), where);
    }
    const std::filesystem::path file = std::filesystem::path(name_).parent_path() / percentDecoded(uri);
    try {
        std::string out = readFile(file);
        opened_(out.size());
        return out;
    } catch (const Error& error) {
        throw Error(where, error.what());
    }
}

std::span<const uint8_t> GltfFile::bufferOf(int buffer) {
    const auto [known, fresh] = buffers_.try_emplace(buffer);
    JsonReader from = item("buffers", buffer);
    from.require("byteLength");
    const size_t length = whole(from, "byteLength", mostBytes);
    std::string uri;
    const bool named = from.get("uri", uri), holds = !named && buffer == 0 && binary_;
    if (fresh) {
        if (named)
            known->second = fetch(uri, from.locate("uri"));
        else if (!holds)
            throw Error(from.here(), "has no bytes: neither a \"uri\" nor a chunk of the file");
    }
    const std::string& all = holds ? *binary_ : known->second;
    if (all.size() < length)
        throw Error(from.locate("byteLength"), "has ", all.size(), " bytes, expected ", length);
    return {reinterpret_cast<const uint8_t*>(all.data()), length};
}

std::span<const uint8_t> GltfFile::rangeOf(JsonReader& from) {
    from.require("buffer");
    const std::span<const uint8_t> all = bufferOf(index(from, "buffer", "buffers"));
    from.require("byteLength");
    const size_t offset = whole(from, "byteOffset", mostBytes), length = whole(from, "byteLength", mostBytes);
    if (offset + length > all.size())
        throw Error(from.locate("byteLength"), "ends at byte ", offset + length, " of a buffer of ",
                    all.size());
    return all.subspan(offset, length);
}

// EXT_meshopt_compression. What its decoders assert is checked before.
std::vector<uint8_t> GltfFile::decompressed(JsonReader& from) {
    const std::span<const uint8_t> packed = rangeOf(from);
    from.require("count");
    from.require("byteStride");
    const size_t count = whole(from, "count", double(mostElements));
    const size_t stride = whole(from, "byteStride", 256);
    int mode = 0, filter = 0;
    from.require("mode");
    from.choose("mode", {"ATTRIBUTES", "TRIANGLES", "INDICES"}, mode);
    from.choose("filter", {"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"}, filter);
    const bool fits = mode == 0   ? stride % 4 == 0
                      : mode == 1 ? (stride == 2 || stride == 4) && count % 3 == 0
                                  : stride == 2 || stride == 4;
    const bool filters = filter == 0 || (mode == 0 && (filter == 1   ? stride == 4 || stride == 8
                                                       : filter == 2 ? stride == 8
                                                                     : stride % 4 == 0));
    if (!fits || !filters) throw Error(from.locate("byteStride"), "does not fit its mode and filter");
    std::vector<uint8_t> out(count * stride);
    if (count == 0) return out;
    const int failed =
        mode == 0   ? meshopt_decodeVertexBuffer(out.data(), count, stride, packed.data(), packed.size())
        : mode == 1 ? meshopt_decodeIndexBuffer(out.data(), count, stride, packed.data(), packed.size())
                    : meshopt_decodeIndexSequence(out.data(), count, stride, packed.data(), packed.size());
    if (failed != 0) throw Error(from.here(), "its compressed bytes are damaged");
    if (filter == 1) meshopt_decodeFilterOct(out.data(), count, stride);
    if (filter == 2) meshopt_decodeFilterQuat(out.data(), count, stride);
    if (filter == 3) meshopt_decodeFilterExp(out.data(), count, stride);
    return out;
}

const GltfFile::View& GltfFile::viewOf(int view) {
    const auto [known, fresh] = views_.try_emplace(view);
    View& out = known->second;
    if (!fresh) return out;
    JsonReader from = item("bufferViews", view);
    out.stride = whole(from, "byteStride", 256);
    if (std::optional<JsonReader> packed = gltfExtension(from, "EXT_meshopt_compression")) {
        out.own = decompressed(*packed);
        out.bytes = out.own;
        out.stride = whole(*packed, "byteStride", 256);
    } else {
        out.bytes = rangeOf(from);
    }
    return out;
}

// Reads elements of a view, from the object's "byteOffset" on.
std::vector<double> GltfFile::read(int view, JsonReader& from, const Elements& kind, size_t count) {
    const View& source = viewOf(view);
    const size_t offset = whole(from, "byteOffset", mostBytes);
    const size_t size = kind.bytes * kind.components, stride = source.stride ? source.stride : size;
    if (count > 0 && (stride < size || offset + (count - 1) * stride + size > source.bytes.size()))
        throw Error(from.here(), "its ", count, " elements end beyond the ", source.bytes.size(),
                    " bytes of their buffer view");
    std::vector<double> out;
    out.reserve(count * kind.components);
    for (size_t i = 0; i < count; ++i)
        for (size_t c = 0; c < kind.components; ++c)
            out.push_back(kind.number(source.bytes.data() + offset + i * stride + c * kind.bytes));
    return out;
}

void GltfFile::readSparse(JsonReader& from, const Elements& kind, GltfArray& out) {
    from.require("count");
    const size_t count = whole(from, "count", double(out.count));
    from.require("indices");
    from.require("values");
    JsonReader places = *from.object("indices"), values = *from.object("values");
    int type = 0;
    places.need("componentType", type);
    places.require("bufferView");
    values.require("bufferView");
    const std::vector<double> indices = read(index(places, "bufferView", "bufferViews"), places,
                                             Elements(type, places.locate("componentType")), count);
    const std::vector<double> numbers = read(index(values, "bufferView", "bufferViews"), values, kind, count);
    for (size_t i = 0; i < count; ++i) {
        if (!(indices[i] >= 0 && indices[i] < double(out.count)))
            throw Error(places.here(), "names element ", indices[i], " of ", out.count);
        std::copy_n(numbers.begin() + std::ptrdiff_t(i * out.components), out.components,
                    out.numbers.begin() + std::ptrdiff_t(size_t(indices[i]) * out.components));
    }
}

const GltfArray& GltfFile::array(int accessor, std::initializer_list<size_t> components) {
    const auto [known, fresh] = arrays_.try_emplace(accessor);
    GltfArray& out = known->second;
    JsonReader from = item("accessors", accessor);
    if (fresh) {
        int type = 0, shape = 0;
        from.require("count");
        out.count = whole(from, "count", double(mostElements));
        from.need("componentType", type);
        from.require("type");
        from.choose("type", {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT4", "MAT2", "MAT3"}, shape);
        Elements kind(type, from.locate("componentType"));
        constexpr size_t sizes[] = {1, 2, 3, 4, 16, 0, 0};  // no array of what we read has the last two
        if (sizes[shape] == 0) throw Error(from.locate("type"), "is not what is read here");
        from.get("normalized", kind.normalized);
        out.components = kind.components = sizes[shape];
        const int view = index(from, "bufferView", "bufferViews");
        if (view >= 0)
            out.numbers = read(view, from, kind, out.count);
        else  // zeros, which take memory by the file's word alone
            out.numbers.resize(out.count * out.components);
        if (std::optional<JsonReader> sparse = from.object("sparse")) readSparse(*sparse, kind, out);
    }
    if (std::find(components.begin(), components.end(), out.components) == components.end())
        throw Error(from.locate("type"), "is not of the kind that is expected of it");
    return out;
}

}  // namespace shoal
