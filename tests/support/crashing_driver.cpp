// Stands in for libOSMesa: a driver that crashes when a context is made.
#include <csignal>

extern "C" {

void* OSMesaCreateContextAttribs(const int*, void*) {
    std::raise(SIGSEGV);
    return nullptr;
}
void OSMesaDestroyContext(void*) {}
unsigned char OSMesaMakeCurrent(void*, void*, unsigned, int, int) {
    return 0;
}
void (*OSMesaGetProcAddress(const char*))() {
    return nullptr;
}

}  // extern "C"
