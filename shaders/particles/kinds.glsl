// Set by C++, each one of these: FACING, and of a picture TILES (which of them shows) with FADES (true: it fades into the
// next one).
const int cameraFacing = 0, velocityFacing = 1, freeFacing = 2;
const int oneTile = 0, tileOfSeed = 1, tilesOnce = 2, tilesAgain = 3;
