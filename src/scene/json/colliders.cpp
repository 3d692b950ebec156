// "colliders" and "surfacePairs": what molecules meet, and how.
#include <algorithm>
#include <cmath>
#include <span>

#include "scene/height_field.h"
#include "scene/json/reader.h"

namespace shoal {

template <typename V>
static void members(V&& v, Either<PlaneCollider> auto& plane) {
    v.number("point", plane.point);
    v.direction("normal", plane.normal);
}

template <typename V>
static void members(V&& v, Either<SphereCollider> auto& sphere) {
    v.number("center", sphere.center);
    v.number("radius", sphere.radius, aboveZero());
}

template <typename V>
static void members(V&& v, Either<BoxCollider> auto& box) {
    v.number("center", box.center);
    v.number("size", box.size, aboveZero());
    v.rotation("rotation", box.rotation);
}

template <typename V>
static void members(V&& v, Either<CapsuleCollider> auto& capsule) {
    v.number("from", capsule.from);
    v.number("to", capsule.to);
    v.number("radius", capsule.radius, aboveZero());
}

template <typename V>
static void members(V&& v, Either<Collider> auto& collider) {
    v.number("restitution", collider.restitution, Range::between(0, 1));
    v.number("friction", collider.friction, Range::atLeast(0));
    v.flag("draw", collider.draw);
    v.color("color", collider.color);
}

template <typename V>
static void members(V&& v, Either<SurfaceRule> auto& rule) {
    v.number("restitution", rule.restitution, Range::between(0, 1));
    v.number("friction", rule.friction, Range::atLeast(0));
}

template <typename V>
static void members(V&& v, Either<Pose> auto& pose) {
    v.number("position", pose.position);
    v.rotation("rotation", pose.rotation);
}

namespace {

const Range thicknesses = Range::atLeast(0);

void checkRectangle(const glm::dvec2& low, const glm::dvec2& high, const Where& where) {
    for (int i = 0; i < 2; ++i)
        if (!(low[i] < high[i]))
            throw Error(where.at("high"), concat("expected high above low along ", i == 0 ? "x" : "z",
                                                 ", found ", high[i], " against ", low[i]));
}

HeightFieldCollider readImageHeights(JsonReader& r) {
    const std::string file = needFile(r, "image");
    glm::dvec2 low(0), high(0), heights(0);
    r.need("low", low);
    r.need("high", high);
    r.need("heights", heights);
    checkRectangle(low, high, r);
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

// Rotations by the short way from one to the next.
void addKeyframe(JsonReader& r, ColliderPath& path) {
    ColliderPath::Keyframe frame;
    r.need("time", frame.time);
    if (!path.keyframes.empty()) checkRises(frame.time, path.end(), r.at("time"));
    frame.pose = readMembers<Pose>(r);
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

void checkKeyframes(const ColliderPath& path, const Where& where) {
    needTwoKeyframes(path.keyframes.size(), where.at("keyframes"));
    if (path.repeats && !same(path.keyframes.front().pose, path.keyframes.back().pose))
        throw Error(where.at("keyframes"),
                    "expected the last pose to be the first again where the path repeats");
}

// A name of "between", which some collider or group must have.
std::string needSurface(const Where& r, const std::string& name, const std::vector<std::string>& known) {
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

void checkRule(const SurfaceRule& rule, std::span<const SurfaceRule> before, const Where& where) {
    if (!rule.restitution && !rule.friction)
        throw Error(where.here(), "expected a \"restitution\" or a \"friction\" between the two");
    for (const SurfaceRule& earlier : before)
        if ((earlier.a == rule.a && earlier.b == rule.b) || (earlier.a == rule.b && earlier.b == rule.a))
            throw Error(where.at("between"),
                        concat("\"", rule.a, "\" and \"", rule.b, "\" already have an entry"));
}

void checkHeights(const HeightFieldCollider& field, const Where& where) {
    const CheckScene check(where);
    check.number("columns", field.columns, Range::atLeast(2));
    check.number("rows", field.rows, Range::atLeast(2));
    check.number("low", field.low);
    check.number("high", field.high);
    checkRectangle(field.low, field.high, where);
    const size_t samples = size_t(field.columns) * size_t(field.rows);
    if (field.heights.size() != samples)
        throw Error(where.at("heights"),
                    concat("expected ", samples, " heights, found ", field.heights.size()));
    for (size_t i = 0; i < samples; ++i)
        if (!(std::abs(field.heights[i]) <= largestNumber)) check.number("heights", field.heights[i]);
}

void checkDistances(const DistanceFieldCollider& collider, const Where& where) {
    const DistanceField& field = collider.field;
    if (field.distances.empty() || field.distances.size() != field.grid.count())
        throw Error(where.at("field"),
                    concat("expected ", field.grid.count(), " distances, one a sample of a grid, found ",
                           field.distances.size()));
}

void checkShape(const ColliderShape& shape, const Where& where) {
    if (const auto* heights = std::get_if<HeightFieldCollider>(&shape)) return checkHeights(*heights, where);
    if (const auto* field = std::get_if<DistanceFieldCollider>(&shape)) return checkDistances(*field, where);
    const CheckScene check(where);
    if (const auto* plane = std::get_if<PlaneCollider>(&shape)) members(check, *plane);
    if (const auto* sphere = std::get_if<SphereCollider>(&shape)) members(check, *sphere);
    if (const auto* box = std::get_if<BoxCollider>(&shape)) members(check, *box);
    if (const auto* capsule = std::get_if<CapsuleCollider>(&shape)) members(check, *capsule);
}

}  // namespace

void checkPath(const ColliderPath& path, const Where& where) {
    for (size_t i = 0; i < path.keyframes.size(); ++i) {
        const Where here = where.in("keyframes", i);
        const CheckScene check(here);
        check.number("time", path.keyframes[i].time);
        if (i > 0) checkRises(path.keyframes[i].time, path.keyframes[i - 1].time, here.at("time"));
        members(check, path.keyframes[i].pose);
    }
    checkKeyframes(path, where);
}

void checkColliders(const Scene& scene) {
    const Where whole;
    std::vector<std::string> names;
    for (size_t i = 0; i < scene.colliders.size(); ++i) {
        const Collider& collider = scene.colliders[i];
        const Where where = whole.in("colliders", i);
        refuseRepeated(where, names, collider.name);
        names.push_back(collider.name);
        CheckScene(where).number("thickness", collider.thickness, thicknesses);
        members(CheckScene(where), collider);
        checkShape(collider.shape, where);
        if (collider.path) checkPath(*collider.path, where.in("path"));
    }
    const std::vector<std::string> known = surfaceNames(scene.colliders, scene.groups);
    for (size_t i = 0; i < scene.surfacePairs.size(); ++i) {
        const SurfaceRule& rule = scene.surfacePairs[i];
        const Where where = whole.in("surfacePairs", i);
        needSurface(where, rule.a, known);
        needSurface(where, rule.b, known);
        members(CheckScene(where), rule);
        checkRule(rule, std::span(scene.surfacePairs).first(i), where);
    }
}

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
    checkKeyframes(path, *r);
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
        r.get("thickness", collider.thickness, thicknesses);
        if (type == 0) collider.shape = readMembers<PlaneCollider>(r);
        if (type == 1) collider.shape = readMembers<SphereCollider>(r, {"center", "radius"});
        if (type == 2) collider.shape = readHeightField(r, models, warnings);
        if (type == 3) collider.shape = readMembers<BoxCollider>(r, {"center", "size"});
        if (type == 4) collider.shape = readMembers<CapsuleCollider>(r, {"from", "to", "radius"});
        if (type == 5) collider.shape = readDistanceField(r, models, collider.thickness, baking, warnings);
        getSurface(r, collider.surface);
        members(ReadScene(r), collider);
        collider.path = readPath(r);
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
        members(ReadScene(r), rule);
        checkRule(rule, rules, r);
        r.finish();
        rules.push_back(std::move(rule));
    }
    return rules;
}

}  // namespace shoal
