#include "scene/water.h"

#include "core/describe.h"

namespace shoal {

const Description& describe(const Water*) {
    static const Description it =
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
    return it;
}

}  // namespace shoal
