// A slot's count of contacts has a flag: whether it takes part in the response. It does with contacts, and in the step after its
// last one, because what contacts remember has acted on it since (contact/respond.glsl).
const uint CONTACTS = 0x7fffffffu;
const uint RESPONDS = 0x80000000u;
// With a sphere's 1/mass, as bits: its molecule has been born since the last step, and remembers nothing.
const uint FRESH = 0x80000000u;
