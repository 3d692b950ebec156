// "colliders" and "surfacePairs": what molecules meet, and how.
#include <algorithm>
#include <cmath>

#include "scene/height_field.h"
#include "scene/scene_reader.h"

namespace shoal {

namespace {

PlaneCollider readPlane(JsonReader& r) {
    PlaneCollider plane;
    r.get("point", plane.point);
    getDirection(r, "normal", plane.normal);
    return plane;
}

SphereCollider readSphere(JsonReader& r) {
    SphereCollider sphere;
    r.need("center", sphere.center);
    r.need("radius", sphere.radius, aboveZero());
    return sphere;
}

HeightFieldCollider readImageHeights(JsonReader& r) {
    const std::string file = needFile(r, "image");
    glm::dvec2 low(0), high(0), heights(0);
    r.need("low", low);
    r.need("high", high);
    r.need("heights", heights);
    for (int i = 0; i < 2; ++i)
        if (!(low[i] < high[i]))
            throw Error(r.at("high"), concat("expected high above low along ", i == 0 ? "x" : "z", ", found ",
                                             high[i], " against ", low[i]));
    const HeightImage image = readHeightPng(file);
    if (image.width < 2 || image.height < 2)
        throw Error(Location{file, 0, 0, {}}, concat("expected an image of at least 2 by 2 pixels, found ",
                                                     image.width, " by ", image.height));
    return heightFieldFromImage(image, low, high, heights);
}

HeightFieldCollider readModelHeights(JsonReader& r, const std::vector<Model>& models,
                                     std::vector<Warning>& warnings) {
    const Model& model = models[size_t(needModel(r, "model", models))];
    int resolution = 257;
    r.get("resolution", resolution, Range::between(2, 4096));
    const Mesh& mesh = model.mesh;
    if (!(mesh.low.x < mesh.high.x && mesh.low.z < mesh.high.z))
        throw Error(r.at("model"), "expected a model that covers an area in x and z, found one seen edge-on");
    int missed = 0;
    HeightFieldCollider heights = heightFieldFromMesh(mesh, resolution, resolution, &missed);
    if (missed > 0)
        warnings.push_back({r.at("model"), concat(missed, " of ", resolution * resolution,
                                                  " height samples have no surface of model \"", model.name,
                                                  "\" beneath; they take its lowest height")});
    return heights;
}

HeightFieldCollider readHeightField(JsonReader& r, const std::vector<Model>& models,
                                    std::vector<Warning>& warnings) {
    if (r.has("image") == r.has("model"))
        throw Error(r.here(), "expected either \"image\" or \"model\" for a height field");
    HeightFieldCollider heights =
        r.has("image") ? readImageHeights(r) : readModelHeights(r, models, warnings);
    int normals = 0;
    r.choose("normals", {"stored", "sampled"}, normals);
    heights.sampledNormals = normals == 1;
    return heights;
}

BoxCollider readBox(JsonReader& r) {
    BoxCollider box;
    r.need("center", box.center);
    r.need("size", box.size, aboveZero());
    getRotation(r, "rotation", box.rotation);
    return box;
}

CapsuleCollider readCapsule(JsonReader& r) {
    CapsuleCollider capsule;
    r.need("from", capsule.from);
    r.need("to", capsule.to);
    r.need("radius", capsule.radius, aboveZero());
    return capsule;
}

Pose readPose(JsonReader& r) {
    Pose pose;
    r.get("position", pose.position);
    getRotation(r, "rotation", pose.rotation);
    return pose;
}

// Rotations by the short way from one to the next.
void addKeyframe(JsonReader& r, ColliderPath& path) {
    ColliderPath::Keyframe frame;
    r.need("time", frame.time);
    if (!path.keyframes.empty() && !(frame.time > path.end()))
        throw Error(r.at("time"), concat("expected a time after that of the keyframe before, ", path.end(),
                                         " s, found ", frame.time));
    frame.pose = readPose(r);
    r.finish();
    if (!path.keyframes.empty() && glm::dot(path.keyframes.back().pose.rotation, frame.pose.rotation) < 0)
        frame.pose.rotation = -frame.pose.rotation;
    path.keyframes.push_back(frame);
}

bool same(const Pose& a, const Pose& b) {
    const double size = 1 + glm::length(a.position);
    return glm::length(a.position - b.position) < 1e-9 * size &&
           std::abs(glm::dot(a.rotation, b.rotation)) > 1 - 1e-9;
}

// A name of "between", which some collider or group must have.
std::string needSurface(const JsonReader& r, const std::string& name, const std::vector<std::string>& known) {
    if (std::find(known.begin(), known.end(), name) != known.end()) return name;
    throw Error(r.at("between"),
                "no collider and no group has the surface \"" + name + "\"" +
                    (known.empty() ? " (none names a \"surface\")" : suggestion(name, known)));
}

std::vector<std::string> surfaceNames(const std::vector<Collider>& colliders,
                                      const std::vector<Group>& groups) {
    std::vector<std::string> names;
    const auto add = [&](const std::string& name) {
        if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end())
            names.push_back(name);
    };
    for (const Collider& collider : colliders)
        add(collider.surface);
    for (const Group& group : groups)
        add(group.surface);
    return names;
}

}  // namespace

std::optional<ColliderPath> readPath(JsonReader& collider) {
    auto r = collider.object("path");
    if (!r) return {};
    ColliderPath path;
    int end = 0, interpolation = 0;
    r->choose("end", {"hold", "repeat"}, end);
    r->choose("interpolation", {"linear", "smooth"}, interpolation);
    path.repeats = end == 1;
    path.smooth = interpolation == 1;
    r->require("keyframes");
    for (JsonReader& frame : r->objects("keyframes"))
        addKeyframe(frame, path);
    if (path.keyframes.size() < 2)
        throw Error(r->at("keyframes"),
                    concat("expected at least two keyframes, found ", path.keyframes.size()));
    if (path.repeats && !same(path.keyframes.front().pose, path.keyframes.back().pose))
        throw Error(r->at("keyframes"),
                    "expected the last pose to be the first again where the path repeats");
    r->finish();
    return path;
}

std::vector<Collider> readColliders(JsonReader& scene, const std::vector<Model>& models,
                                    const FieldBaking& baking, std::vector<Warning>& warnings) {
    std::vector<Collider> colliders;
    std::vector<std::string> names;
    for (JsonReader& r : scene.objects("colliders")) {
        Collider collider;
        r.get("name", collider.name);
        refuseRepeated(r, names, collider.name);
        names.push_back(collider.name);
        int type = 0;
        r.require("type");
        r.choose("type", {"plane", "sphere", "heightField", "box", "capsule", "distanceField"}, type);
        r.get("thickness", collider.thickness, Range::atLeast(0));
        if (type == 0) collider.shape = readPlane(r);
        if (type == 1) collider.shape = readSphere(r);
        if (type == 2) collider.shape = readHeightField(r, models, warnings);
        if (type == 3) collider.shape = readBox(r);
        if (type == 4) collider.shape = readCapsule(r);
        if (type == 5) collider.shape = readDistanceField(r, models, collider.thickness, baking, warnings);
        getSurface(r, collider.surface);
        r.get("restitution", collider.restitution, Range::between(0, 1));
        r.get("friction", collider.friction, Range::atLeast(0));
        collider.path = readPath(r);
        r.get("draw", collider.draw);
        getColor(r, "color", collider.color);
        r.finish();
        colliders.push_back(std::move(collider));
    }
    return colliders;
}

bool getSurface(JsonReader& reader, std::string& out) {
    if (!reader.get("surface", out)) return false;
    if (out.empty())
        throw Error(reader.at("surface"), "expected the name of a surface, found an empty string");
    return true;
}

std::vector<SurfaceRule> readSurfacePairs(JsonReader& scene, const std::vector<Collider>& colliders,
                                          const std::vector<Group>& groups) {
    const std::vector<std::string> known = surfaceNames(colliders, groups);
    std::vector<SurfaceRule> rules;
    for (JsonReader& r : scene.objects("surfacePairs")) {
        std::vector<std::string> between;
        r.need("between", between);
        if (between.size() != 2)
            throw Error(r.at("between"),
                        concat("expected the names of two surfaces, found ", between.size()));
        SurfaceRule rule;
        rule.a = needSurface(r, between[0], known);
        rule.b = needSurface(r, between[1], known);
        getOptional(r, "restitution", rule.restitution, Range::between(0, 1));
        getOptional(r, "friction", rule.friction, Range::atLeast(0));
        if (!rule.restitution && !rule.friction)
            throw Error(r.here(), "expected a \"restitution\" or a \"friction\" between the two");
        for (const SurfaceRule& earlier : rules)
            if ((earlier.a == rule.a && earlier.b == rule.b) || (earlier.a == rule.b && earlier.b == rule.a))
                throw Error(r.at("between"),
                            concat("\"", rule.a, "\" and \"", rule.b, "\" already have an entry"));
        r.finish();
        rules.push_back(std::move(rule));
    }
    return rules;
}

}  // namespace shoal
