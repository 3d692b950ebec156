#include "scene/scene.h"

#include "core/describe.h"
#include "scene/water.h"

namespace shoal {

namespace {

const std::vector<std::string> samplingWords = {"vertexSubstep", "vertexFrame", "moleculeFrame"};
const std::vector<std::string> searchWords = {"exact", "single", "staggered"};
const std::vector<std::string> responseWords = {"simultaneous", "nearest"};

}  // namespace

InstanceColors instanceColors(const Group& group) {
    const Material& material = group.molecule.material;
    InstanceColors out;
    out.first = group.color.value_or(material.color);
    const std::optional<glm::dvec3> second =
        group.secondColor || group.color ? group.secondColor : material.secondColor;
    out.second = second.value_or(out.first);
    out.variation = group.variation.value_or(second ? usualVariation : 0);
    return out;
}

const char* name(FieldSampling sampling) {
    return samplingWords[size_t(sampling)].c_str();
}

const char* name(ContactSearch search) {
    return searchWords[size_t(search)].c_str();
}

const char* name(ContactResponse response) {
    return responseWords[size_t(response)].c_str();
}

const Description& describe(const SolverSettings*) {
    using S = SolverSettings;
    static const Description description =
        Describe<S>("solver", "How molecules are advanced.")
            .location(&S::location)
            .word("method", &S::kind, solverWords(),
                  {"", "The method: `auto` takes what suits each group, the others hold for all."})
            .key("substeps", &S::substeps,
                 {"", "The number of substeps of a frame.", Range::between(1, maxSubsteps)})
            .word("fieldSampling", &S::fieldSampling, samplingWords,
                  {"", "Where and how often fields are read."});
    return description;
}

const Description& describe(const ContactSettings*) {
    using S = ContactSettings;
    static const Description description =
        Describe<S>("contact", "Contact of molecules with one another.")
            .location(&S::location)
            .key("steps", &S::steps,
                 {"", "The contact steps of a frame, at most one a substep; one a substep without it.",
                  Range::between(1, maxSubsteps)})
            .unlessZero()
            .key(
                "iterations", &S::iterations,
                {"",
                 "The most iterations of the response where several touch at once; without it 8, times the "
                 "square root of how many times as heavy as the lightest the heaviest is that contact moves, "
                 "or 1.5 times the levels of the tallest tower of solids, 256 at most.",
                 Range::between(1, S::mostIterations)})
            .unlessZero()
            .key(
                "tolerance", &S::tolerance,
                {"",
                 "The residual at which the iterations end: by how much the relative velocity of two spheres "
                 "that touch may differ from what is asked, as a part of what gravity adds in two contact "
                 "steps, and how far they are moved apart, as a part of the radius. Floats give no less "
                 "than 1e-5; without gravity all iterations run.",
                 Range::between(1e-5, 1)})
            .word("search", &S::search, searchWords,
                  {"",
                   "How spheres that may touch are found; `single` and `staggered` are UberFlow's, which "
                   "miss some."})
            .key("neighbors", &S::neighbors,
                 {"", "How many places to either side UberFlow's searches look at.", Range::between(1, 64)})
            .only("search", {"single", "staggered"})
            .word("response", &S::response, responseWords,
                  {"", "Whether all that touch respond at once, or, as UberFlow's, the nearest alone."})
            .key(
                "fastest", &S::fastest,
                {"m/s",
                 "The speed of two spheres relative to one another up to which they do not pass through each "
                 "other between two contact steps; without it a diameter of the smaller one a step.",
                 aboveZero()})
            .key("rest", &S::rest,
                 {"m/s",
                  "The speed below which a molecule comes to rest when none of its vertices has got further "
                  "in a quarter of a second. It then costs next to nothing until something wakes it: an "
                  "impact that reaches it, or what would change its velocity in a contact step by more than "
                  "this, or than a tenth of what gravity does where that is more. Without it none rests.",
                  aboveZero()})
            .key("cell", &S::cell,
                 {"m",
                  "The size of a cell, at least 4.1 times the largest radius, and more with `fastest`; "
                  "best left out: cells are then as large as is needed.",
                  aboveZero()});
    return description;
}

const Description& describe(const Camera*) {
    static const auto rule = [](const Camera& camera, const Where& where) {
        if (camera.eye == camera.target) throw Error(where.here(), "expected eye and target apart");
    };
    static const Description description =
        Describe<Camera>("camera", "From where the scene is seen.")
            .key("eye", &Camera::eye, {"m", "Where the camera is."})
            .key("target", &Camera::target, {"m", "The point in the middle of the picture."})
            .key("fieldOfView", &Camera::fieldOfView,
                 {"rad", "The angle between the picture's lower and upper edge.", Range::between(0.01, 3.1)})
            .key("exposure", &Camera::exposure, {"", "What multiplies the light.", aboveZero()})
            .rule(rule);
    return description;
}

const Description& describe(const Light*) {
    static const Description description =
        Describe<Light>("light", "The sun.")
            .direction("direction", &Light::direction, {"", "The direction in which its light travels."})
            .color("color", &Light::color, {"", "Its colour."})
            .key("intensity", &Light::intensity, {"", "Its strength.", Range::atLeast(0)})
            .key("shadows", &Light::shadows, {"", "Whether it casts shadows."});
    return description;
}

const Description& describe(const Sky*) {
    static const Description description =
        Describe<Sky>("sky", "The sky, which lights from all sides.")
            .color("zenith", &Sky::zenith, {"", "Its colour overhead."})
            .color("horizon", &Sky::horizon, {"", "Its colour at the horizon."})
            .color("ground", &Sky::ground, {"", "The colour of what lies below the horizon."})
            .key("intensity", &Sky::intensity, {"", "Its strength.", Range::atLeast(0)})
            .key("fog", &Sky::fog, {"1/m", "How fast the horizon's colour covers things.", Range::atLeast(0)})
            .key("clouds", &Sky::clouds,
                 {"", "The share of it that clouds cover; they are drawn, and cast no shadows.",
                  Range::between(0, 1)})
            .key("occlusion", &Sky::occlusion,
                 {"", "How much darker it is where near things hide the sky; 0: not at all, which is faster.",
                  Range::between(0, 1)});
    return description;
}

const Description& describe(const Drag*) {
    static const Description description =
        Describe<Drag>("drag", "Stokes drag that differs with the direction.")
            .key("normal", &Drag::normal, {"1/s", "The drag rate across the surface.", Range::atLeast(0)})
            .needed()
            .key("tangent", &Drag::tangent, {"1/s", "The drag rate along the surface.", Range::atLeast(0)})
            .needed();
    return description;
}

const Description& describe(const Release*) {
    static const auto rule = [](const Release& release, const Where& where) {
        if (!release.force && !release.rate)
            throw Error(where.here(), "expected a \"force\" or a \"rate\" at which pins let go");
    };
    static const Description description =
        Describe<Release>("release", "When pins let go; all pins of a molecule do so together.")
            .key("force", &Release::force,
                 {"N",
                  "They let go when the springs pull on one of them by more: the length of the sum of the "
                  "forces, damping included, of all springs at that vertex; gravity, drag and forces on "
                  "the pin itself do not count.",
                  aboveZero()})
            .key("rate", &Release::rate,
                 {"1/s", "They let go at random, at this rate per molecule.", aboveZero()})
            .key("after", &Release::after, {"s", "They hold before this time.", Range::atLeast(0)})
            .rule(rule, R"({"anyOf": [{"required": ["force"]}, {"required": ["rate"]}]})");
    return description;
}

const Description& describe(const GroupContact*) {
    using C = GroupContact;
    static const Description description =
        Describe<C>("contact",
                    "Contact with the molecules of any group that has it: spheres at the vertices.")
            .location(&C::location)
            .key("radius", &C::radius,
                 {"m", "The radius of the sphere at each vertex, times the instance's scale.", aboveZero()})
            .usually("what closes the gaps: half of the largest; of a point half of its drawn size")
            .key("triangles", &C::triangles,
                 {"", "Whether there is a sphere at the middle of each triangle, too."})
            .key("closed", &C::closed,
                 {"",
                  "Whether there are as many along edges and over triangles as it takes to let none of a "
                  "like molecule's edges and corners pass."})
            .key("self", &C::self,
                 {"",
                  "Whether spheres of one molecule meet, too, but for those that are closer than two radii "
                  "in its rest shape."});
    return description;
}

const Description& describe(const ColorScale*) {
    using C = ColorScale;
    static constexpr const char* noColor = "expected a colour: three numbers from 0 to 1";
    static const auto readColors = [](JsonReader& r, C& scale, void*) {
        const JsonValue* list = r.raw("colors");
        if (!list) return;
        if (list->kind != JsonValue::Kind::array)
            throw Error(r.locate("colors"), "expected an array of colours, found ", name(list->kind));
        scale.colors.clear();
        for (const JsonValue& item : list->items) {
            glm::dvec3 color(-1);
            if (item.kind == JsonValue::Kind::array && item.items.size() == 3)
                for (int i = 0; i < 3; ++i)
                    if (item.items[size_t(i)].kind == JsonValue::Kind::number)
                        color[i] = item.items[size_t(i)].number;
            scale.colors.push_back(color);
        }
    };
    static const auto rule = [](const C& scale, const Where& where) {
        if (scale.to - scale.from < leastPositive)
            throw Error(where.locate("to"), "expected \"to\" above \"from\" (", scale.from, "), found ",
                        scale.to);
        if (scale.colors.size() < leastScaleColors || scale.colors.size() > mostScaleColors)
            throw Error(where.locate("colors"), "expected ", leastScaleColors, " to ", mostScaleColors,
                        " colours, found ", scale.colors.size());
        for (size_t i = 0; i < scale.colors.size(); ++i)
            for (int c = 0; c < 3; ++c)
                if (!contains(Range::between(0, 1), scale.colors[i][c]))
                    throw Error(where.in("colors", i).here(), noColor);
    };
    static const Description description =
        Describe<C>("colorBy",
                    "Colours by what molecules do, in place of their own; they multiply those of "
                    "particles and of images.")
            .word("quantity", &C::quantity, {"speed"},
                  {"", "The quantity: the speed is that of the mean velocity, in m/s."})
            .key("from", &C::from, {"", "The quantity of the first colour, and below it."})
            .key("to", &C::to, {"", "The quantity of the last colour, above `from`, and beyond it."})
            .needed()
            .byHand(
                "colors",
                {.value = Form::Value::number, .lists = {{2, 8}, {3, 3}}, .range = Range::between(0, 1)},
                {"2 to 8 colours, each from 0 to 1",
                 "Colours at even distances, linear between. Those of the default rise in lightness in even "
                 "steps, so that the picture can be read in grey as well."},
                readColors)
            .usually("dark blue over green to yellow")
            .rule(rule);
    return description;
}

const Description& describe(const Water*) {
    static const Description description =
        Describe<Water>("water", "The scene is under water: what the picture makes of it.")
            .key("surface", &Water::surface, {"m", "The y of the calm surface; all below it is water."})
            .key("extinction", &Water::extinction,
                 {"1/m", "How fast water takes red, green and blue out of light.",
                  Range::between(0, mostExtinction)})
            .color("scattering", &Water::scattering, {"", "The colour of endless water."})
            .key("caustics", &Water::caustics,
                 {"", "The strength of the bright net on what the sun reaches.", Range::between(0, 1)})
            .key("causticsSize", &Water::causticsSize, {"m", "The size of its meshes.", aboveZero()})
            .key("causticsSpeed", &Water::causticsSpeed,
                 {"m/s", "The speed at which it runs.", Range::atLeast(0)})
            .key("rays", &Water::rays,
                 {"", "The strength of the beams through the water.", Range::between(0, 1)});
    return description;
}

}  // namespace shoal
