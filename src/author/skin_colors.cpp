// The colours of a mesh's parts in one image, because a molecule is drawn with one: each material has a tile.
#include <algorithm>
#include <cmath>
#include <map>

#include "author/from_mesh.h"
#include "core/srgb.h"

namespace shoal {

namespace {

constexpr int mostTexels = 2048;      // a side of the image
constexpr int gutter = 4;             // texels around each tile, so that smaller mip levels do not mix them
constexpr int plainTexels = 8;        // a side of a tile of one colour
constexpr double mostRepeats = 8;     // of an image across a tile
constexpr double withinImage = 1e-4;  // how far coordinates may reach beyond an image that is not repeated

uint8_t encoded(double linear) {
    return uint8_t(std::lround(255 * srgbOfLinear(std::clamp(linear, 0.0, 1.0))));
}

double decoded(uint8_t srgb) {
    return linearOfSrgb(srgb / 255.0);
}

struct Tile {
    glm::dvec3 color{1};           // multiplies the image
    const Image* image = nullptr;  // null: one colour
    bool cut = false;              // holes are kept
    glm::dvec2 repeats{1};         // of the image across the tile
    glm::ivec2 size{plainTexels};  // texels
    glm::ivec2 place{0};           // of its first texel in the whole image
};

class Gathering {
  public:
    Gathering(Mesh& mesh, std::vector<std::string>& notes) : mesh_(mesh), notes_(notes) {}

    std::optional<Image> run() {
        findTiles();
        const bool plain = std::none_of(tiles_.begin(), tiles_.end(), [](const Tile& t) { return t.image; });
        if (tiles_.empty() || (plain && tiles_.size() == 1)) return std::nullopt;
        separateCorners();
        findRepeats();
        place();
        Image out = drawn();
        moveCoordinates();
        return out;
    }

  private:
    // One for each material that a part has, and one for parts without.
    void findTiles() {
        tileOf_.assign(mesh_.triangles.size(), -1);
        std::map<int, int> known;
        for (const Mesh::Part& part : mesh_.parts) {
            const auto [entry, fresh] = known.try_emplace(part.look, int(tiles_.size()));
            if (fresh) tiles_.push_back(tileOf(part));
            std::fill_n(tileOf_.begin() + part.firstTriangle, part.triangleCount, entry->second);
        }
        if (!std::count(tileOf_.begin(), tileOf_.end(), -1)) return;
        std::replace(tileOf_.begin(), tileOf_.end(), -1, int(tiles_.size()));
        tiles_.emplace_back();
    }

    Tile tileOf(const Mesh::Part& part) {
        Tile tile;
        tile.color = meanColor(part);
        if (part.look < 0) return tile;
        const SurfaceMaterial& material = mesh_.materials[size_t(part.look)];
        tile.color *= glm::dvec3(material.color);
        tile.cut = material.alpha == SurfaceMaterial::Alpha::cut;
        if (material.colorImage >= 0 && !mesh_.uvs.empty()) {
            tile.image = &mesh_.images[size_t(material.colorImage)];
            tile.size = {tile.image->width, tile.image->height};
        }
        const auto note = [&](const char* what) {
            notes_.push_back(concat("material \"", part.material, "\": ", what));
        };
        if (material.alpha == SurfaceMaterial::Alpha::blend)
            note("it is blended in the file, and opaque in the skin");
        if (std::max({material.normalImage, material.roughnessImage, material.emissiveImage}) >= 0 ||
            material.emissive != glm::dvec3(0))
            note("bumps, roughness images and emitted light are not drawn in a skin");
        return tile;
    }

    glm::dvec3 meanColor(const Mesh::Part& part) const {
        if (mesh_.colors.empty()) return glm::dvec3(1);
        glm::dvec3 sum(0);
        for (int t = 0; t < part.triangleCount; ++t)
            for (int corner = 0; corner < 3; ++corner)
                sum += glm::clamp(
                    mesh_.colors[size_t(mesh_.triangles[size_t(part.firstTriangle + t)][corner])], 0.0, 1.0);
        return sum / (3.0 * part.triangleCount);
    }

    // From now on each triangle has corners of its own, whose coordinates begin within the image.
    void separateCorners() {
        // The tiles point to the images, which are large: they stay where they are.
        std::vector<Image> images = std::move(mesh_.images);
        Mesh out = mesh_;
        out.positions.clear(), out.normals.clear(), out.uvs.clear(), out.colors.clear(), out.weld.clear();
        for (glm::ivec3& triangle : out.triangles) {
            glm::dvec2 low(0);
            if (!mesh_.uvs.empty())
                low = glm::floor(
                    glm::min(glm::min(mesh_.uvs[size_t(triangle.x)], mesh_.uvs[size_t(triangle.y)]),
                             mesh_.uvs[size_t(triangle.z)]) +
                    withinImage);
            for (int corner = 0; corner < 3; ++corner) {
                const auto from = size_t(triangle[corner]);
                triangle[corner] = int(out.positions.size());
                out.positions.push_back(mesh_.positions[from]);
                out.normals.push_back(mesh_.normals[from]);
                out.weld.push_back(mesh_.weld[from]);
                out.uvs.push_back(mesh_.uvs.empty() ? glm::dvec2(0) : mesh_.uvs[from] - low);
                if (!mesh_.colors.empty()) out.colors.push_back(mesh_.colors[from]);
            }
        }
        out.images = std::move(images);
        mesh_ = std::move(out);
    }

    void findRepeats() {
        for (size_t t = 0; t < mesh_.triangles.size(); ++t) {
            Tile& tile = tiles_[size_t(tileOf_[t])];
            for (int corner = 0; corner < 3; ++corner)
                tile.repeats = glm::max(
                    tile.repeats, glm::ceil(mesh_.uvs[size_t(mesh_.triangles[t][corner])] - withinImage));
        }
        for (Tile& tile : tiles_) {
            if (!tile.image) tile.repeats = glm::dvec2(1);
            if (std::max(tile.repeats.x, tile.repeats.y) > mostRepeats)
                notes_.push_back(concat("an image that a triangle repeats more than ", mostRepeats,
                                        " times is stretched in the skin"));
            tile.repeats = glm::min(tile.repeats, glm::dvec2(mostRepeats));
            tile.size = glm::ivec2(glm::dvec2(tile.size) * tile.repeats);
        }
    }

    // In rows from the highest to the lowest tile; all are halved until they fit.
    void place() {
        std::vector<Tile*> order;
        for (Tile& tile : tiles_)
            order.push_back(&tile);
        std::stable_sort(order.begin(), order.end(),
                         [](const Tile* a, const Tile* b) { return a->size.y > b->size.y; });
        for (;; halve())
            for (width_ = 16; width_ <= mostTexels; width_ *= 2)
                if (fits(order)) return;
    }

    void halve() {
        for (Tile& tile : tiles_)
            if (tile.image) tile.size = glm::max(tile.size / 2, glm::ivec2(1));
    }

    bool fits(const std::vector<Tile*>& order) {
        const int around = order.size() > 1 ? gutter : 0;
        glm::ivec2 corner(0);
        int rowHeight = 0;
        for (Tile* tile : order) {
            const glm::ivec2 needed = tile->size + 2 * around;
            if (needed.x > width_) return false;
            if (corner.x + needed.x > width_) corner = {0, corner.y + rowHeight}, rowHeight = 0;
            tile->place = corner + around;
            corner.x += needed.x;
            rowHeight = std::max(rowHeight, needed.y);
        }
        height_ = corner.y + rowHeight;
        return height_ <= std::min(2 * width_, mostTexels);
    }

    Image drawn() const {
        Image out{width_, height_, 4, std::vector<uint8_t>(size_t(width_) * size_t(height_) * 4, 255)};
        for (const Tile& tile : tiles_) {
            const int around = tiles_.size() > 1 ? gutter : 0;
            for (int y = -around; y < tile.size.y + around; ++y)
                for (int x = -around; x < tile.size.x + around; ++x) {
                    const size_t texel = size_t(tile.place.y + y) * size_t(width_) + size_t(tile.place.x + x);
                    write(tile, (glm::dvec2(x, y) + 0.5) / glm::dvec2(tile.size), &out.pixels[texel * 4]);
                }
        }
        return out;
    }

    // `position`: in the tile, from its upper left; beyond 0 to 1 in the gutter.
    static void write(const Tile& tile, const glm::dvec2& position, uint8_t* texel) {
        glm::dvec3 color = tile.color;
        if (tile.image) {
            // The mean of the texels that the tile's own covers.
            const Image& image = *tile.image;
            const glm::ivec2 size(image.width, image.height);
            const glm::dvec2 step = tile.repeats * glm::dvec2(size) / glm::dvec2(tile.size);
            const glm::ivec2 count = glm::max(glm::ivec2(glm::round(step)), glm::ivec2(1));
            const glm::dvec2 corner = position * tile.repeats * glm::dvec2(size) - 0.5 * step;
            glm::dvec3 sum(0);
            double alpha = 0;
            for (int j = 0; j < count.y; ++j)
                for (int i = 0; i < count.x; ++i) {
                    glm::ivec2 from(glm::floor(corner + (glm::dvec2(i, j) + 0.5) * step / glm::dvec2(count)));
                    from = (from % size + size) % size;
                    const uint8_t* source =
                        &image.pixels[(size_t(from.y) * size_t(size.x) + size_t(from.x)) * 4];
                    sum += glm::dvec3(decoded(source[0]), decoded(source[1]), decoded(source[2]));
                    alpha += source[3];
                }
            color *= sum / double(count.x * count.y);
            if (tile.cut) texel[3] = uint8_t(std::lround(alpha / (count.x * count.y)));
        }
        for (int c = 0; c < 3; ++c)
            texel[c] = encoded(color[c]);
    }

    // Coordinates have their origin at the lower left.
    void moveCoordinates() {
        const glm::dvec2 whole(width_, height_);
        for (size_t t = 0; t < mesh_.triangles.size(); ++t) {
            const Tile& tile = tiles_[size_t(tileOf_[t])];
            for (int corner = 0; corner < 3; ++corner) {
                glm::dvec2& uv = mesh_.uvs[size_t(mesh_.triangles[t][corner])];
                glm::dvec2 share = tile.image ? glm::clamp(uv / tile.repeats, 0.0, 1.0) : glm::dvec2(0.5);
                share.y = 1 - share.y;
                const glm::dvec2 position = (glm::dvec2(tile.place) + share * glm::dvec2(tile.size)) / whole;
                uv = {position.x, 1 - position.y};
            }
        }
    }

    Mesh& mesh_;
    std::vector<std::string>& notes_;
    std::vector<Tile> tiles_;
    std::vector<int> tileOf_;  // of each triangle
    int width_ = 0, height_ = 0;
};

}  // namespace

std::optional<Image> gatherColors(Mesh& mesh, std::vector<std::string>& notes) {
    return Gathering(mesh, notes).run();
}

void chooseLooks(const Mesh& mesh, Material& looks) {
    glm::dvec3 color(1);
    if (!mesh.colors.empty()) {
        color = glm::dvec3(0);
        for (const glm::dvec3& vertexColor : mesh.colors)
            color += glm::clamp(vertexColor, 0.0, 1.0) / double(mesh.colors.size());
    }
    glm::dvec3 factor(0);
    double roughness = 0, metallic = 0;
    int known = 0;
    for (const Mesh::Part& part : mesh.parts) {
        if (part.look < 0) continue;
        const SurfaceMaterial& material = mesh.materials[size_t(part.look)];
        factor += double(part.triangleCount) * glm::dvec3(material.color);
        roughness += part.triangleCount * material.roughness;
        metallic += part.triangleCount * material.metallic;
        known += part.triangleCount;
    }
    const auto rounded3 = [](double value) { return std::round(value * 1e3) / 1e3; };
    const bool said = !mesh.colors.empty() || (known > 0 && factor != glm::dvec3(known));
    if (known > 0) color *= factor / double(known);
    if (said) looks.color = glm::round(color * 1e3) / 1e3;
    if (known == 0) return;
    if (roughness != known * SurfaceMaterial().roughness) looks.roughness = rounded3(roughness / known);
    looks.metallic = rounded3(metallic / known);
}

}  // namespace shoal
