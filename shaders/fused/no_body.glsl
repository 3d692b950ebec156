// A molecule whose vertices answer colliders one by one (fused/body.glsl).
void answerAsBody()
{
}
