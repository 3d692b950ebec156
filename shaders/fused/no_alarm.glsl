// The step does not look for states that have run away (fused/alarm.glsl).
void watch()
{
}

bool comesTooLate()
{
    return false;
}
