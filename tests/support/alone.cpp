// A program of one room and those below it (tests/CMakeLists.txt): that it links is the test.
int main() {}
