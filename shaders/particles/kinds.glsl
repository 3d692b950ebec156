// Set by C++, each one of these: SHAPE; FACING, of quads; TILES, which of a picture's shows. A point is a dot of so many
// pixels; a sprite is a point as wide as the turned square, which the fragment stage cuts out of it [Latta 2004, section
// 3.4.6]; a quad has four corners [Kapoulkine 2008].
//
// Set by C++, true or false: AGES, particles are born or die; SIZES, they differ in size; GROWS, with age; TURNS, about the
// line of sight, or free quads about their axis; IMAGE, else a dot; FADES, a tile into the next one; LIT; SOFT, in front of
// surfaces; COLOR_BY, their speed colours them.
const int pointsShape = 0, spritesShape = 1, quadsShape = 2;
const int cameraFacing = 0, velocityFacing = 1, freeFacing = 2;
const int oneTile = 0, tileOfSeed = 1, tilesOnce = 2, tilesAgain = 3;
