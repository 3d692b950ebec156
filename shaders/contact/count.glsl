// The count of a slot's contacts, and whether it takes part in the response: because it has contacts, or because it had some in
// the last step, whose impulses have acted on it since.
const uint CONTACTS = 0x7fffffffu;
const uint RESPONDS = 0x80000000u;
