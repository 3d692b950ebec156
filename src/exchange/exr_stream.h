// OpenEXR's stream into a file that is whole or not there.
#pragma once

#include <filesystem>
#include <utility>

#include <OpenEXR/ImfIO.h>

#include "core/file.h"

namespace shoal::exchange {

Error diskFull(const std::filesystem::path& file);

class ExrStream : public Imf::OStream {
  public:
    using Position = decltype(std::declval<Imf::OStream&>().tellp());  // differs between versions

    // Error: PartFile's.
    explicit ExrStream(const std::filesystem::path& target) : OStream(target.c_str()), part_(target) {}
    void write(const char data[], int count) override;  // Error: disk full
    Position tellp() override { return position_; }
    void seekp(Position position) override { position_ = position; }
    void finish() { part_.replaceTarget(); }

  private:
    PartFile part_;
    Position position_ = 0;
};

}  // namespace shoal::exchange
