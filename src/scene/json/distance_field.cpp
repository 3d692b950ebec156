// "colliders" of type distanceField.
#include "geometry/distance_field_cache.h"
#include "scene/json/reader.h"

namespace shoal {

DistanceFieldCollider readDistanceField(JsonReader& r, const std::vector<Model>& models, double thickness,
                                        const FieldBaking& baking, std::vector<Warning>& warnings) {
    DistanceFieldCollider out;
    const Model& model = models[size_t(needModel(r, "model", models))];
    out.model = model.name;
    FieldRequest& request = out.request;
    request.thickness = thickness;
    if (r.has("resolution") && r.has("error"))
        throw Error(r.at("error"), "expected either \"resolution\" or \"error\", found both");
    int resolution = 0;
    if (r.get("resolution", resolution, Range::between(leastResolution, mostResolution)))
        request.resolution = resolution;
    getOptional(r, "error", request.error, aboveZero());
    getOptional(r, "shell", request.shell, aboveZero());
    try {
        out.field = distanceFieldOf(model.mesh, request, baking, warnings);
    } catch (const Error& error) {
        const char* key = request.error ? "error" : request.resolution ? "resolution" : "model";
        throw Error(r.at(key), concat("model \"", model.name, "\": ", error.message()));
    }
    for (const std::string& warning : fieldWarnings(out.field, request))
        warnings.push_back({r.at("model"), concat("model \"", model.name, "\" ", warning)});
    return out;
}

}  // namespace shoal
