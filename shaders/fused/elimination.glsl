// The solution of A s = r for a molecule of a lane a vertex, with 3x3 blocks that lie beside the state, in doubles (the
// tables and what is worked out: src/compile/newton.h). Lanes share the blocks of a round.

// Of the molecules of a dispatch, number n of molecule m of a workgroup at (workgroup * NUMBERS + n) * LANES + m.
layout(std430) coherent buffer MatrixNumbers { double matrixNumbers[]; };

const int KNOWN = 0;  // z, m
const int SOLUTION = 3 * MOLECULE_VERTICES;  // r, then s
const int MATRIX = 6 * MOLECULE_VERTICES;    // blocks, column by column
const int NUMBERS = MATRIX + 9 * MATRIX_BLOCKS;

// First entry of the molecule's table.
int matrixTable()
{
    return topologyBase + 2 * MOLECULE_VERTICES + TRIANGLES;
}

void waitForNumbers()
{
    memoryBarrierBuffer();
    waitForGroup();
}

int numberIndex(int number)
{
    return (int(gl_WorkGroupID.x) * NUMBERS + number) * LANES + column();
}

// Three of them.
dvec3 numbers(int number)
{
    int index = numberIndex(number);
    return dvec3(matrixNumbers[index], matrixNumbers[index + LANES], matrixNumbers[index + 2 * LANES]);
}

void setNumbers(int number, dvec3 values)
{
    int index = numberIndex(number);
    matrixNumbers[index] = values.x;
    matrixNumbers[index + LANES] = values.y;
    matrixNumbers[index + 2 * LANES] = values.z;
}

dmat3 matrixBlock(int block)
{
    int number = MATRIX + 9 * block;
    return dmat3(numbers(number), numbers(number + 3), numbers(number + 6));
}

void setMatrixBlock(int block, dmat3 value)
{
    int number = MATRIX + 9 * block;
    setNumbers(number, value[0]);
    setNumbers(number + 3, value[1]);
    setNumbers(number + 6, value[2]);
}

void clearMatrix()
{
    for (int b = row(); b < MATRIX_BLOCKS; b += ROWS) setMatrixBlock(b, dmat3(0.0));
}

// 0 where a vertex is held.
double inverseRoot(double pivot)
{
    return pivot > 0.0 ? 1.0 / sqrt(pivot) : 0.0;
}

// The inverse of the Cholesky factor of a symmetric matrix.
dmat3 inverseFactor(dmat3 a)
{
    double k0 = inverseRoot(a[0][0]);
    double l10 = a[0][1] * k0;
    double l20 = a[0][2] * k0;
    double k1 = inverseRoot(a[1][1] - l10 * l10);
    double l21 = (a[1][2] - l20 * l10) * k1;
    double k2 = inverseRoot(a[2][2] - l20 * l20 - l21 * l21);
    double k10 = -l10 * k0 * k1;
    return dmat3(k0, k10, -(l20 * k0 + l21 * k10) * k2, 0.0, k1, -l21 * k1 * k2, 0.0, 0.0, k2);
}

// Works out one block, but for K(j) of those off the diagonal; with one on it, the solution forwards.
void eliminate(int block, vec4 entry)
{
    bool isDiagonal = int(entry.y) == block;
    dmat3 sum = matrixBlock(block);
    int place = SOLUTION + 3 * int(entry.x);
    dvec3 right = isDiagonal ? numbers(place) : dvec3(0.0);
    int end = matrixTable() + int(entry.w);
    for (int t = matrixTable() + int(entry.z); t < end; ++t) {
        vec4 term = table(t);
        dmat3 first = matrixBlock(int(term.x));
        sum -= first * transpose(matrixBlock(int(term.y)));
        if (isDiagonal) right -= first * numbers(SOLUTION + 3 * int(term.z));
    }
    if (isDiagonal) {
        sum = inverseFactor(sum);
        setNumbers(place, sum * right);
    }
    setMatrixBlock(block, sum);
}

// Works out the solution at a place backwards.
void substitute(vec4 entry, int firstBlock)
{
    dvec3 sum = dvec3(0.0);
    for (int b = int(entry.x) + 1; b < int(entry.y); ++b) {
        sum += numbers(SOLUTION + 3 * int(table(firstBlock + b).x)) * matrixBlock(b);
    }
    int place = SOLUTION + 3 * int(entry.z);
    setNumbers(place, (numbers(place) - sum) * matrixBlock(int(entry.x)));
}

void solveMatrix()
{
    vec4 head = table(matrixTable());
    int firstRound = matrixTable() + 1 + MOLECULE_VERTICES;
    int firstPlace = matrixTable() + int(head.y);
    int firstBlock = matrixTable() + int(head.z);
    int rounds = int(head.x);
    for (int r = 0; r < rounds; ++r) {
        waitForNumbers();
        vec4 spans = table(firstRound + r);
        for (int b = int(spans.z) + row(); b < int(spans.w); b += ROWS) eliminate(b, table(firstBlock + b));
        waitForNumbers();
        for (int b = int(spans.z) + row(); b < int(spans.w); b += ROWS) {
            int diagonal = int(table(firstBlock + b).y);
            if (diagonal != b) setMatrixBlock(b, matrixBlock(b) * transpose(matrixBlock(diagonal)));
        }
    }
    for (int r = rounds - 1; r >= 0; --r) {
        waitForNumbers();
        vec4 spans = table(firstRound + r);
        for (int p = int(spans.x) + row(); p < int(spans.y); p += ROWS) substitute(table(firstPlace + p), firstBlock);
    }
    waitForNumbers();
}
