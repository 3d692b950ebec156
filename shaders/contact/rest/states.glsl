// Who moves a molecule over the next step: w of its spheres' loads (contact/arrays.txt). docs/contact.md draws how the states follow one another:
// *just rested* is COME_TO_REST; what is *settling* is AWAKE with its clock running (w of `restPoses`); what is *woken* still has RESTING
// here, and a mark (contact/flags.glsl), until rest.pass.glsl has seen it.
const float HELD_BY_CONTACT = -1.0;  // its step, but contact alone holds it off the colliders
const float AWAKE = 0.0;             // its step
const float RESTING = 1.0;           // nobody
const float COME_TO_REST = 2.0;      // nobody; its next step tells what velocity it would gain

bool isResting(float state)
{
    return state > AWAKE;
}
