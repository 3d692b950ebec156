// Reads 3MF through lib3mf: what the build places, objects and components with their transforms, in metres.
#include <algorithm>
#include <cmath>
#include <map>

#include <Model/COM/NMR_DLLInterfaces.h>

#include "core/file.h"
#include "core/srgb.h"
#include "geometry/model_images.h"
#include "geometry/model_reader.h"
#include "geometry/polygons.h"

namespace shoal {

namespace {

constexpr double metresOfUnit[] = {1e-6, 1e-3, 1e-2, 0.0254, 0.3048, 1};  // by lib3mf's number of a unit

// An object of lib3mf's.
class Held {
  public:
    Held() = default;
    Held(const Held&) = delete;
    Held& operator=(const Held&) = delete;
    ~Held() {
        if (pointer_) NMR::lib3mf_release(pointer_);
    }
    NMR::PLib3MFBase** out() { return &pointer_; }
    operator NMR::PLib3MFBase*() const { return pointer_; }

  private:
    NMR::PLib3MFBase* pointer_ = nullptr;
};

glm::dmat4 matrix(const NMR::MODELTRANSFORM& transform) {
    glm::dmat4 out(1);
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column)
            out[column][row] = transform.m_fFields[row][column];
    return out;
}

class Reader3mf {
  public:
    explicit Reader3mf(const ModelFile& model) : model_(model), images_(model, mesh_.images) {}

    Mesh read() {
        std::string bytes = readFile(model_.name);
        model_.opened(bytes.size());
        Held reader;
        need(NMR::lib3mf_createmodel(document_.out()));
        need(NMR::lib3mf_model_queryreader(document_, "3mf", reader.out()));
        if (NMR::lib3mf_reader_readfrombuffer(reader, reinterpret_cast<BYTE*>(bytes.data()), bytes.size()) !=
            0) {
            DWORD code = 0;
            LPCSTR why = nullptr;
            NMR::lib3mf_getlasterror(reader, &code, &why);
            throw fail(concat("cannot be read as 3MF: ", why ? why : "lib3mf does not say why"));
        }
        tellWarnings(reader);
        DWORD unit = NMR::MODELUNIT_MILLIMETER;
        need(NMR::lib3mf_model_getunit(document_, &unit));
        const double metres = metresOfUnit[std::min<size_t>(unit, std::size(metresOfUnit) - 1)];
        placeItems(glm::dmat4(glm::dmat3(metres)));
        if (!anyColors_) mesh_.colors.clear();
        if (!anyUvs_) mesh_.uvs.clear();
        if (opacity_) note("its colours' opacity is not drawn");
        tellOfRounding(mesh_);
        return std::move(mesh_);
    }

  private:
    Error fail(const std::string& message) const { return Error(Location{model_.name}, message); }
    void need(HRESULT result) const {
        if (result != 0) throw fail(concat("cannot be read as 3MF: lib3mf refuses it with ", result));
    }
    void note(const std::string& what) {
        if (std::find(mesh_.notes.begin(), mesh_.notes.end(), what) == mesh_.notes.end())
            mesh_.notes.push_back(what);
    }

    // The text that `get` writes into a buffer.
    template <typename Get>
    std::string textOf(const Get& get) const {
        char buffer[256] = "";
        ULONG needed = 0;
        if (get(buffer, ULONG(sizeof buffer - 1), &needed) != 0) return {};
        return buffer;
    }

    void tellWarnings(const Held& reader) {
        // These tell of identifiers for printers, of metadata, and of a colour for triangles without one.
        constexpr DWORD ofNothingDrawn[] = {0x80b0, 0x80b2, 0x80bb};
        DWORD count = 0;
        need(NMR::lib3mf_reader_getwarningcount(reader, &count));
        for (DWORD i = 0; i < count && mesh_.notes.size() < 10; ++i) {
            DWORD code = 0;
            const std::string text = textOf([&](char* buffer, ULONG size, ULONG* needed) {
                return NMR::lib3mf_reader_getwarningutf8(reader, i, &code, buffer, size, needed);
            });
            if (std::find(std::begin(ofNothingDrawn), std::end(ofNothingDrawn), code) ==
                std::end(ofNothingDrawn))
                note(concat("lib3mf leaves something out: ", text));
        }
    }

    // ---- Places

    void placeItems(const glm::dmat4& metres) {
        Held items;
        need(NMR::lib3mf_model_getbuilditems(document_, items.out()));
        BOOL more = false;
        bool any = false;
        for (need(NMR::lib3mf_builditemiterator_movenext(items, &more)); more;
             need(NMR::lib3mf_builditemiterator_movenext(items, &more))) {
            Held item, object;
            NMR::MODELTRANSFORM transform{};
            BOOL moved = false;
            need(NMR::lib3mf_builditemiterator_getcurrent(items, item.out()));
            need(NMR::lib3mf_builditem_getobjectresource(item, object.out()));
            need(NMR::lib3mf_builditem_hasobjecttransform(item, &moved));
            if (moved) need(NMR::lib3mf_builditem_getobjecttransform(item, &transform));
            place(object, moved ? metres * matrix(transform) : metres, "", 0);
            any = true;
        }
        if (!any) throw fail("has no triangles: its build places nothing");
    }

    // The name of an object without one is that of what it is a component of.
    void place(const Held& object, const glm::dmat4& transform, std::string name, int depth) {
        if (depth > 100) throw fail("has components nested deeper than 100");
        const std::string own = textOf([&](char* buffer, ULONG size, ULONG* needed) {
            return NMR::lib3mf_object_getnameutf8(object, buffer, size, needed);
        });
        if (!own.empty()) name = own;
        BOOL isMesh = false;
        need(NMR::lib3mf_object_ismeshobject(object, &isMesh));
        if (isMesh) {
            DWORD id = 0;
            need(NMR::lib3mf_resource_getresourceid(object, &id));
            const auto [known, fresh] = pieces_.try_emplace(id);
            if (fresh) known->second = pieceOf(object);
            append(known->second, transform, name);
            return;
        }
        DWORD count = 0;
        need(NMR::lib3mf_componentsobject_getcomponentcount(object, &count));
        for (DWORD i = 0; i < count; ++i) {
            Held component, part;
            NMR::MODELTRANSFORM moved{};
            BOOL has = false;
            need(NMR::lib3mf_componentsobject_getcomponent(object, i, component.out()));
            need(NMR::lib3mf_component_getobjectresource(component, part.out()));
            need(NMR::lib3mf_component_hastransform(component, &has));
            if (has) need(NMR::lib3mf_component_gettransform(component, &moved));
            place(part, has ? transform * matrix(moved) : transform, name, depth + 1);
        }
    }

    void append(const Mesh& piece, const glm::dmat4& transform, const std::string& name) {
        if (mesh_.positions.size() + piece.positions.size() > mostElements ||
            mesh_.triangles.size() + piece.triangles.size() > mostElements)
            throw fail("has more than 2^28 vertices or triangles, the most that are read");
        const int first = int(mesh_.positions.size()), firstTriangle = int(mesh_.triangles.size());
        const glm::dmat3 m(transform);
        const glm::dmat3 cofactor(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
        const bool mirrored = glm::determinant(m) < 0;
        for (size_t i = 0; i < piece.positions.size(); ++i) {
            const glm::dvec3 p(transform * glm::dvec4(piece.positions[i], 1));
            if (!isWithinReach(p))
                throw fail(concat("vertex ", i, " of object \"", name, "\" lies at no place within ",
                                  farthest, " m"));
            const glm::dvec3 normal = cofactor * piece.normals[i] * (mirrored ? -1.0 : 1.0);
            mesh_.positions.push_back(p);
            mesh_.normals.push_back(unit(normal));
            mesh_.colors.push_back(piece.colors.empty() ? glm::dvec3(1) : piece.colors[i]);
            mesh_.uvs.push_back(piece.uvs.empty() ? glm::dvec2(0) : piece.uvs[i]);
        }
        for (glm::ivec3 t : piece.triangles) {
            if (mirrored) std::swap(t.y, t.z);  // keeps anticlockwise in front
            mesh_.triangles.push_back(t + first);
        }
        for (Mesh::Part part : piece.parts) {
            part.mesh = name;
            part.firstTriangle += firstTriangle;
            mesh_.parts.push_back(std::move(part));
        }
        if (!piece.triangles.empty())
            mesh_.objects.push_back({name, firstTriangle, int(piece.triangles.size())});
        anyColors_ = anyColors_ || !piece.colors.empty();
        anyUvs_ = anyUvs_ || !piece.uvs.empty();
    }

    // ---- Meshes

    Mesh pieceOf(const Held& object) {
        DWORD vertices = 0, triangles = 0, beams = 0;
        need(NMR::lib3mf_meshobject_getvertexcount(object, &vertices));
        need(NMR::lib3mf_meshobject_gettrianglecount(object, &triangles));
        need(NMR::lib3mf_meshobject_getbeamcount(object, &beams));
        if (beams > 0)
            mesh_.losses.push_back(concat("the beams of a lattice are not read, ", beams, " of them"));
        std::vector<NMR::MODELMESHVERTEX> places(vertices);
        std::vector<NMR::MODELMESHTRIANGLE> corners(triangles);
        if (vertices > 0) need(NMR::lib3mf_meshobject_getvertices(object, places.data(), vertices, nullptr));
        if (triangles > 0)
            need(NMR::lib3mf_meshobject_gettriangleindices(object, corners.data(), triangles, nullptr));
        Mesh piece;
        for (const NMR::MODELMESHVERTEX& v : places)
            piece.positions.emplace_back(v.m_fPosition[0], v.m_fPosition[1], v.m_fPosition[2]);
        piece.normals.assign(places.size(), glm::dvec3(0));
        Polygons polygons;
        Held properties, usual;
        need(NMR::lib3mf_meshobject_createpropertyhandler(object, properties.out()));
        need(NMR::lib3mf_object_createdefaultpropertyhandler(object, usual.out()));
        for (DWORD i = 0; i < triangles; ++i) {
            for (const DWORD index : corners[i].m_nIndices) {
                if (index >= vertices)
                    throw fail(concat("has a triangle with vertex ", index, " of a mesh of ", vertices));
                polygons.corners.push_back(int(index));
            }
            polygons.polygons.push_back({3 * size_t(i), 3, lookOf(properties, usual, i, polygons)});
        }
        const std::vector<int> looks = polygons.addTo(piece, model_.name);
        for (size_t i = 0; i < looks.size(); ++i) {
            piece.parts[i].look = looks[i];
            if (looks[i] >= 0) piece.parts[i].material = lookNames_[size_t(looks[i])];
        }
        return piece;
    }

    // The material of a triangle, -1 for none; adds the colours or texture coordinates of its corners.
    int lookOf(const Held& properties, const Held& usual, DWORD triangle, Polygons& polygons) {
        auto type = NMR::MODELPROPERTYTYPE_NONE;
        need(NMR::lib3mf_propertyhandler_getpropertytype(properties, triangle, &type));
        if (type == NMR::MODELPROPERTYTYPE_BASEMATERIALS) {
            DWORD group = 0, index = 0;
            need(NMR::lib3mf_propertyhandler_getbasematerial(properties, triangle, &group, &index));
            return baseMaterial(group, index);
        }
        if (type == NMR::MODELPROPERTYTYPE_COLOR) {
            NMR::MODELMESH_TRIANGLECOLOR_SRGB colors{};
            need(NMR::lib3mf_propertyhandler_getcolor(properties, triangle, &colors));
            polygons.cornerColors.resize(polygons.corners.size() - 3, glm::dvec3(1));
            for (const NMR::MODELMESHCOLOR_SRGB& c : colors.m_Colors)
                polygons.cornerColors.push_back(colorOf(c.m_Red, c.m_Green, c.m_Blue, c.m_Alpha));
            return -1;
        }
        if (type == NMR::MODELPROPERTYTYPE_TEXCOORD2D) {
            NMR::MODELMESHTEXTURE2D texture{};
            need(NMR::lib3mf_propertyhandler_gettexture(properties, triangle, &texture));
            polygons.cornerUvs.resize(polygons.corners.size() - 3, glm::dvec2(0));
            for (int k = 0; k < 3; ++k)
                polygons.cornerUvs.push_back(finiteUv({texture.m_fU[k], texture.m_fV[k]}));
            return texturedMaterial(texture.m_nTextureID);
        }
        return usualLook(usual, polygons);
    }

    // Returns the look that an object gives all triangles that name none.
    int usualLook(const Held& usual, Polygons& polygons) {
        auto type = NMR::MODELPROPERTYTYPE_NONE;
        need(NMR::lib3mf_defaultpropertyhandler_getpropertytype(usual, &type));
        if (type == NMR::MODELPROPERTYTYPE_BASEMATERIALS) {
            DWORD group = 0, index = 0;
            need(NMR::lib3mf_defaultpropertyhandler_getbasematerial(usual, &group, &index));
            return baseMaterial(group, index);
        }
        if (type == NMR::MODELPROPERTYTYPE_COLOR) {
            NMR::MODELMESHCOLOR_SRGB c{};
            need(NMR::lib3mf_defaultpropertyhandler_getcolor(usual, 0, &c));
            polygons.cornerColors.resize(polygons.corners.size() - 3, glm::dvec3(1));
            polygons.cornerColors.resize(polygons.corners.size(),
                                         colorOf(c.m_Red, c.m_Green, c.m_Blue, c.m_Alpha));
        }
        return -1;
    }

    // ---- Looks

    glm::dvec3 colorOf(BYTE red, BYTE green, BYTE blue, BYTE alpha) {
        opacity_ = opacity_ || alpha < 255;
        return linearOfSrgb(glm::dvec3(red, green, blue) / 255.0);
    }

    int baseMaterial(DWORD group, DWORD index) {
        const auto [known, fresh] = bases_.try_emplace({group, index}, int(mesh_.materials.size()));
        if (!fresh) return known->second;
        Held base;
        BYTE red = 255, green = 255, blue = 255, alpha = 255;
        need(NMR::lib3mf_model_getbasematerialbyid(document_, group, base.out()));
        need(NMR::lib3mf_basematerial_getdisplaycolor(base, index, &red, &green, &blue, &alpha));
        SurfaceMaterial look;
        look.color = glm::dvec4(linearOfSrgb(glm::dvec3(red, green, blue) / 255.0), alpha / 255.0);
        if (alpha < 255) look.alpha = SurfaceMaterial::Alpha::blend;
        mesh_.materials.push_back(look);
        lookNames_.push_back(textOf([&](char* buffer, ULONG size, ULONG* needed) {
            return NMR::lib3mf_basematerial_getnameutf8(base, index, buffer, size, needed);
        }));
        return known->second;
    }

    int texturedMaterial(DWORD id) {
        const auto [known, fresh] = textures_.try_emplace(id, int(mesh_.materials.size()));
        if (!fresh) return known->second;
        Held texture, attachment;
        need(NMR::lib3mf_model_gettexture2dbyid(document_, id, texture.out()));
        const std::string path = textOf([&](char* buffer, ULONG size, ULONG* needed) {
            return NMR::lib3mf_texture2d_getpathutf8(texture, buffer, size, needed);
        });
        NMR::eModelTextureTileStyle u = NMR::MODELTEXTURETILESTYLE_WRAP, v = u;
        need(NMR::lib3mf_texture2d_gettilestyleuv(texture, &u, &v));
        if (u != NMR::MODELTEXTURETILESTYLE_WRAP || v != NMR::MODELTEXTURETILESTYLE_WRAP)
            note(concat("image \"", path, "\" is repeated beyond its borders, whatever the file says"));
        SurfaceMaterial look;
        look.colorImage = images_.kept(
            path,
            [&] {
                ULONG64 size = 0;
                if (NMR::lib3mf_texture2d_getattachment(texture, attachment.out()) != 0 ||
                    NMR::lib3mf_attachment_getstreamsize(attachment, &size) != 0 || size > (1u << 30))
                    throw Error("the package does not hold it");
                std::string bytes(size_t(size), '\0');
                need(NMR::lib3mf_attachment_writetobuffer(attachment, reinterpret_cast<BYTE*>(bytes.data()),
                                                          size));
                return images_.decoded(bytes, path);
            },
            [&](const std::string& why) {
                note(concat("its colour image \"", path, "\" is left out: ", why));
            });
        if (look.colorImage >= 0 && anyTransparent(mesh_.images[size_t(look.colorImage)]))
            look.alpha = SurfaceMaterial::Alpha::cut;
        mesh_.materials.push_back(look);
        lookNames_.push_back(path);
        return known->second;
    }

    const ModelFile& model_;
    Held document_;
    Mesh mesh_;
    ModelImages images_;
    std::map<DWORD, Mesh> pieces_;  // by the number of the mesh in the file
    std::map<std::pair<DWORD, DWORD>, int> bases_;
    std::map<DWORD, int> textures_;
    std::vector<std::string> lookNames_;  // beside Mesh::materials
    bool anyColors_ = false, anyUvs_ = false, opacity_ = false;
};

}  // namespace

Mesh read3mf(const ModelFile& model) {
    return Reader3mf(model).read();
}

}  // namespace shoal
