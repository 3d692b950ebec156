#include "exchange/usda_materials.h"

#include "core/error.h"
#include "core/image.h"
#include "exchange/usda_text.h"

namespace shoal::exchange {

std::string UsdMaterials::imageFile(const DrawnMesh& mesh, int image, const std::string& material) {
    const std::filesystem::path path =
        file_.parent_path() / concat(file_.stem().string(), "-", material, "-", image, ".png");
    writePng(path, mesh.images[size_t(image)]);
    images_.push_back(path.string());
    return path.filename().string();
}

std::string UsdMaterials::add(const DrawnMesh& mesh, const SurfaceMaterial& looks) {
    const std::string name = concat("m", count_++), path = "/scene/materials/" + name;
    std::string inputs, shaders;
    const auto reader = [&](const char* reads, int image, const char* output, const char* space) {
        const std::string shader = concat(reads, "Image");
        shaders += concat("            def Shader \"", shader,
                          "\"\n            {\n                uniform token info:id = \"UsdUVTexture\"\n"
                          "                asset inputs:file = @./",
                          imageFile(mesh, image, name),
                          "@\n                token inputs:sourceColorSpace = \"", space,
                          "\"\n                token inputs:wrapS = \"repeat\"\n"
                          "                token inputs:wrapT = \"repeat\"\n"
                          "                float2 inputs:st.connect = <",
                          path, "/st.outputs:result>\n                ", output, "\n            }\n");
        return concat("<", path, "/", shader);
    };
    const auto scalar = [&](const char* input, double value) {
        inputs += concat("                float inputs:", input, " = ", value, "\n");
    };
    if (looks.colorImage >= 0) {
        const std::string source =
            reader("color", looks.colorImage, "float3 outputs:rgb\n                float outputs:a", "sRGB");
        inputs += concat("                color3f inputs:diffuseColor.connect = ", source, ".outputs:rgb>\n");
        if (looks.alpha != SurfaceMaterial::Alpha::opaque)
            inputs += concat("                float inputs:opacity.connect = ", source, ".outputs:a>\n");
    } else if (!mesh.colors.empty()) {
        shaders +=
            "            def Shader \"vertexColor\"\n            {\n"
            "                uniform token info:id = \"UsdPrimvarReader_float3\"\n"
            "                string inputs:varname = \"displayColor\"\n"
            "                float3 outputs:result\n            }\n";
        inputs += concat("                color3f inputs:diffuseColor.connect = <", path,
                         "/vertexColor.outputs:result>\n");
        if (!mesh.opacities.empty()) {
            shaders +=
                "            def Shader \"vertexOpacity\"\n            {\n"
                "                uniform token info:id = \"UsdPrimvarReader_float\"\n"
                "                string inputs:varname = \"displayOpacity\"\n"
                "                float outputs:result\n            }\n";
            inputs += concat("                float inputs:opacity.connect = <", path,
                             "/vertexOpacity.outputs:result>\n");
        } else if (looks.color.a < 1) {
            scalar("opacity", looks.color.a);
        }
    } else {
        inputs += concat(
            "                color3f inputs:diffuseColor = ", usda::text(glm::dvec3(looks.color)), "\n");
        if (looks.color.a < 1) scalar("opacity", looks.color.a);
    }
    if (looks.alpha == SurfaceMaterial::Alpha::cut) scalar("opacityThreshold", looks.alphaCut);
    if (looks.normalImage >= 0)
        inputs += concat("                normal3f inputs:normal.connect = ",
                         reader("normal", looks.normalImage, "float3 outputs:rgb", "raw"), ".outputs:rgb>\n");
    if (looks.roughnessImage >= 0) {
        const std::string source = reader("roughness", looks.roughnessImage,
                                          "float outputs:g\n                float outputs:b", "raw");
        inputs += concat("                float inputs:roughness.connect = ", source, ".outputs:g>\n",
                         "                float inputs:metallic.connect = ", source, ".outputs:b>\n");
    } else {
        scalar("roughness", looks.roughness);
        scalar("metallic", looks.metallic);
    }
    if (looks.emissive != glm::dvec3(0))
        inputs += concat("                color3f inputs:emissiveColor = ", usda::text(looks.emissive), "\n");
    text_ += concat("        def Material \"", name,
                    "\"\n        {\n            token outputs:surface.connect = <", path,
                    "/surface.outputs:surface>\n            def Shader \"surface\"\n            {\n"
                    "                uniform token info:id = \"UsdPreviewSurface\"\n",
                    inputs, "                token outputs:surface\n            }\n", shaders,
                    "            def Shader \"st\"\n            {\n"
                    "                uniform token info:id = \"UsdPrimvarReader_float2\"\n"
                    "                string inputs:varname = \"st\"\n                float2 outputs:result\n"
                    "            }\n        }\n");
    return path;
}

}  // namespace shoal::exchange
