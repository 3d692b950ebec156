// Drivers are tried in a child process first, where a crash of theirs is an error of ours.
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>

#include "core/cache_folder.h"
#include "core/child_process.h"
#include "core/file.h"
#include "gpu/platform.h"

namespace shoal::gpu {

namespace fs = std::filesystem;

std::string crashInChild(const std::function<void()>& make) {
    constexpr double patience = 20;  // s
    ChildProcess child([&] {
        const int nothing = ::open("/dev/null", O_RDWR);
        for (int stream = 0; stream < 3; ++stream)
            ::dup2(nothing, stream);
        try {
            make();
        } catch (...) {
            ::_exit(1);
        }
    });
    // A child that fails, or has not ended, proves nothing: the program itself finds out more.
    const std::optional<int> status = child.wait(patience);
    if (!status || !WIFSIGNALED(*status)) return {};
    const std::string driver = environment("GALLIUM_DRIVER");
    return concat("its driver crashes when a context is made (", ::strsignal(WTERMSIG(*status)), ")",
                  driver.empty() ? "" : concat("; GALLIUM_DRIVER is ", driver));
}

TriedDriver::TriedDriver(const std::string& folder, const std::string& kind, std::optional<int> device) {
    if (folder.empty()) return;
    std::string all = concat(kind, " ", device.value_or(-1));
    for (const char* variable :
         {"GALLIUM_DRIVER", "MESA_LOADER_DRIVER_OVERRIDE", "LIBGL_ALWAYS_SOFTWARE", "LIBGL_DRIVERS_PATH",
          "MESA_GL_VERSION_OVERRIDE", "__EGL_VENDOR_LIBRARY_DIRS", "__EGL_VENDOR_LIBRARY_FILENAMES",
          "__GLX_VENDOR_LIBRARY_NAME", "EGL_PLATFORM", "LD_LIBRARY_PATH", "LD_PRELOAD"})
        all += concat("\n", variable, "=", environment(variable));
    mark_ = fs::path(folder) / (contentKey(all) + ".driver");
}

bool TriedDriver::isKnown() const {
    std::error_code code;
    return mark_.empty() || fs::exists(mark_, code);
}

void TriedDriver::remember() const {
    try {
        writeFile(mark_, std::string_view("a context was made\n"));
    } catch (const Error&) {
        // it is tried again
    }
}

}  // namespace shoal::gpu
