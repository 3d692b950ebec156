// Nothing is marked where no molecule may rest (contact/rest/mark_groups.glsl).
void noneMarked()
{
}
