// Materials of a stage as UsdPreviewSurface, with their images beside the stage's file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "exchange/drawn_mesh.h"

namespace shoal::exchange {

class UsdMaterials {
  public:
    explicit UsdMaterials(std::filesystem::path stage) : file_(std::move(stage)) {}
    // Writes its images; returns the material's path within the stage. Error: an image cannot be written.
    std::string add(const DrawnMesh& mesh, const SurfaceMaterial& looks);
    const std::string& text() const { return text_; }
    const std::vector<std::string>& images() const { return images_; }  // files

  private:
    std::string imageFile(const DrawnMesh& mesh, int image, const std::string& material);

    std::filesystem::path file_;
    std::string text_;
    std::vector<std::string> images_;
    int count_ = 0;
};

}  // namespace shoal::exchange
