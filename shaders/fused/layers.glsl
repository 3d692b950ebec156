// A fragment has a molecule of the layers; its draw stores the record with the state.
int ownMolecule()
{
    return int(gl_FragCoord.y) * STATE_WIDTH + int(gl_FragCoord.x);
}

void storeRecord(int molecule)
{
}
