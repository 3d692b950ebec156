#include "exchange/layered_image.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <half.h>
#include <unistd.h>

#include "core/error.h"
#include "exchange/exr_stream.h"

namespace shoal::exchange {

Error diskFull(const std::filesystem::path& file) {
    return Error(Location{file.string(), 0, 0, {}}, "cannot be written: is the disk full?");
}

void ExrStream::write(const char data[], int count) {
    if (::pwrite(part_.file(), data, size_t(count), off_t(position_)) != count) throw diskFull(fileName());
    position_ += Position(count);
}

void writeExr(const std::filesystem::path& file, int width, int height,
              const std::vector<ImageChannel>& channels) {
    ExrStream stream(file);
    Imf::Header header{width, height};
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer buffer;
    std::vector<std::vector<half>> halves(channels.size());
    for (size_t c = 0; c < channels.size(); ++c) {
        const ImageChannel& channel = channels[c];
        const Imf::PixelType type = channel.whole ? Imf::FLOAT : Imf::HALF;
        halves[c].assign(channel.values.begin(), channel.values.end());
        header.channels().insert(channel.name, Imf::Channel(type));
        const void* first = channel.whole ? static_cast<const void*>(channel.values.data())
                                          : static_cast<const void*>(halves[c].data());
        const size_t each = channel.whole ? sizeof(float) : sizeof(half);
        buffer.insert(channel.name, Imf::Slice(type, static_cast<char*>(const_cast<void*>(first)), each,
                                               each * size_t(width)));
    }
    {
        Imf::OutputFile out(stream, header);
        out.setFrameBuffer(buffer);
        out.writePixels(height);
    }
    stream.finish();
}

}  // namespace shoal::exchange
