#include "scene/collider.h"

#include "core/describe.h"

namespace shoal {

const Description& describe(const PlaneCollider*) {
    using C = PlaneCollider;
    static const Description it =
        Describe<C>("plane", "A plane, solid behind.")
            .key("point", &C::point, {"m", "A point of the plane."})
            .direction("normal", &C::normal, {"", "The direction of the free side."});
    return it;
}

const Description& describe(const SphereCollider*) {
    using C = SphereCollider;
    static const Description it = Describe<C>("sphere", "A sphere.")
                                      .key("center", &C::center, {"m", "Its centre."})
                                      .needed()
                                      .key("radius", &C::radius, {"m", "Its radius.", aboveZero()})
                                      .needed();
    return it;
}

const Description& describe(const BoxCollider*) {
    using C = BoxCollider;
    static const Description it = Describe<C>("box", "A box.")
                                      .key("center", &C::center, {"m", "Its centre."})
                                      .needed()
                                      .key("size", &C::size, {"m", "Its whole edges.", aboveZero()})
                                      .needed()
                                      .rotation("rotation", &C::rotation, {"", "How it is turned."});
    return it;
}

const Description& describe(const CapsuleCollider*) {
    using C = CapsuleCollider;
    static const Description it =
        Describe<C>("capsule", "All within a radius of a line between two points.")
            .key("from", &C::from, {"m", "One end of the line."})
            .needed()
            .key("to", &C::to, {"m", "The other end; where both coincide it is a sphere."})
            .needed()
            .key("radius", &C::radius, {"m", "The radius.", aboveZero()})
            .needed();
    return it;
}

const Description& describe(const Collider*) {
    using C = Collider;
    static const auto rule = [](const C& collider, const Where& where) {
        if (where.given("surface") && collider.surface.empty())
            throw Error(where.at("surface"), "expected the name of a surface, found an empty string");
    };
    static const Description it =
        Describe<C>("collider", "What molecules collide with.")
            .key("name", &C::name, {"", "Its name in messages and in the panel; no two have the same."})
            .key("thickness", &C::thickness,
                 {"m", "The distance at which vertices rest from the surface.", Range::atLeast(0)})
            .alternatives("type", &C::shape, {"", "Which solid it is."})
            .key("surface", &C::surface, {"", "What it is made of, for `surfacePairs`."})
            .key("restitution", &C::restitution,
                 {"", "The speed after a bounce, as a share of that before.", Range::between(0, 1)})
            .key("friction", &C::friction,
                 {"", "Coulomb's coefficient: the tangential change is at most this times the normal one.",
                  Range::atLeast(0)})
            .key("draw", &C::draw,
                 {"", "Whether it is drawn; height and distance fields show as their model."})
            .color("color", &C::color, {"", "Its colour."})
            .key("path", &C::path, {"", "How it moves; without a path it stands still."})
            .rule(rule, R"({"properties": {"surface": {"minLength": 1}}})");
    return it;
}

const Description& describe(const SurfaceRule*) {
    using S = SurfaceRule;
    static const auto readPair = [](JsonReader& r, S& pair, void*) {
        std::vector<std::string> between;
        r.need("between", between);
        if (between.size() != 2)
            throw Error(r.at("between"),
                        concat("expected the names of two surfaces, found ", between.size()));
        pair.a = between[0];
        pair.b = between[1];
    };
    static const auto rule = [](const S& pair, const Where& where) {
        if (!pair.restitution && !pair.friction)
            throw Error(where.here(), "expected a \"restitution\" or a \"friction\" between the two");
    };
    static const Description it =
        Describe<S>("surfacePair",
                    "Restitution and friction between two surfaces, in place of a collider's own.")
            .byHand(
                "between",
                R"({"type": "array", "minItems": 2, "maxItems": 2, "items": {"type": "string", "minLength": 1}})",
                {"the names of two surfaces", "The two surfaces, in any order."}, readPair)
            .needed()
            .key("restitution", &S::restitution,
                 {"", "The speed after a bounce, as a share of that before.", Range::between(0, 1)})
            .key("friction", &S::friction, {"", "Coulomb's coefficient.", Range::atLeast(0)})
            .rule(rule, R"({"anyOf": [{"required": ["restitution"]}, {"required": ["friction"]}]})");
    return it;
}

const char* kindName(const ColliderShape& shape) {
    return std::visit([](const auto& kind) { return describe(&kind).name().c_str(); }, shape);
}

}  // namespace shoal
