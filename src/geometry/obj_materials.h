// Reads the materials of OBJ models (MTL). For read_obj.cpp alone.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "geometry/model_images.h"

namespace shoal {

class ObjMaterials {
  public:
    // Adds to the mesh's materials, images and notes.
    ObjMaterials(const ModelFile& model, Mesh& mesh);

    // Reads what stands behind `mtllib`: a file's name with blanks, or several names.
    void readLibraries(const std::string& names);
    // Returns a material's number in Mesh::materials; -1: there is none of that name, which is told where the
    // model names a file of materials.
    int numberOf(const std::string& name);
    // Where a material's images lie, all as the first of them: texture coordinates times scale plus shift.
    struct Placement {
        glm::dvec2 scale{1}, shift{0};
        bool operator==(const Placement&) const = default;
    };
    Placement placementOf(int number) const;

  private:
    void readLibrary(const std::string& name);

    const ModelFile& model_;
    Mesh& mesh_;
    ModelImages images_;
    std::map<std::string, int> numbers_;
    std::vector<Placement> placements_;  // of each material
    bool named_ = false;                 // the model names a file of materials
};

}  // namespace shoal
