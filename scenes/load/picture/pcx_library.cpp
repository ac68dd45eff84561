// The library that decode_pcx loads. It must not need any other part of the house.
#include "scenes/load/picture/pcx.h"

extern "C" {
#include <libavcodec/avcodec.h>
}

#include <array>
#include <cstddef>
#include <cstring>
#include <memory>
#include <new>

namespace shadowproof {

namespace {

struct Free {
    void operator()(AVCodecContext* context) const { avcodec_free_context(&context); }
    void operator()(AVPacket* packet) const { av_packet_free(&packet); }
    void operator()(AVFrame* frame) const { av_frame_free(&frame); }
};

template <class T>
std::unique_ptr<T, Free> owned(T* made) {
    if (made == nullptr) throw std::bad_alloc();
    return std::unique_ptr<T, Free>(made);
}

std::string damaged(int code) {
    std::array<char, AV_ERROR_MAX_STRING_SIZE> reason{};
    av_strerror(code, reason.data(), reason.size());
    return std::string("is damaged (") + reason.data() + ")";
}

void write_rgb(const AVFrame& frame, std::vector<std::uint8_t>& rgb) {
    const auto width = static_cast<std::size_t>(frame.width);
    rgb.resize(3 * width * static_cast<std::size_t>(frame.height));
    for (int y = 0; y < frame.height; ++y) {
        const std::uint8_t* const row = frame.data[0] + std::ptrdiff_t{y} * frame.linesize[0];
        std::uint8_t* at = rgb.data() + 3 * width * static_cast<std::size_t>(y);
        if (frame.format == AV_PIX_FMT_RGB24) {
            std::memcpy(at, row, 3 * width);
            continue;
        }
        for (std::size_t x = 0; x < width; ++x) {
            // Alpha, red, green and blue, from the highest byte of a number to its lowest.
            std::uint32_t color = 0;
            std::memcpy(&color, frame.data[1] + sizeof color * row[x], sizeof color);
            *at++ = static_cast<std::uint8_t>(color >> 16U);
            *at++ = static_cast<std::uint8_t>(color >> 8U);
            *at++ = static_cast<std::uint8_t>(color);
        }
    }
}

std::string decode(std::span<const unsigned char> bytes, int width, int height,
                   std::vector<std::uint8_t>& rgb) {
    av_log_set_level(AV_LOG_QUIET);
    const AVCodec* const codec = avcodec_find_decoder(AV_CODEC_ID_PCX);
    if (codec == nullptr) return "is a PCX picture, which this libavcodec does not decode";
    const auto context = owned(avcodec_alloc_context3(codec));
    context->thread_count = 1;
    context->err_recognition = AV_EF_EXPLODE;
    // It counts rows as it pads them.
    context->max_pixels = std::int64_t{width + pcx_padding} * height;
    if (const int failure = avcodec_open2(context.get(), codec, nullptr); failure < 0)
        return damaged(failure);
    const auto packet = owned(av_packet_alloc());
    if (av_new_packet(packet.get(), static_cast<int>(bytes.size())) < 0) throw std::bad_alloc();
    std::memcpy(packet->data, bytes.data(), bytes.size());
    const auto frame = owned(av_frame_alloc());
    int failure = avcodec_send_packet(context.get(), packet.get());
    if (failure >= 0) failure = avcodec_receive_frame(context.get(), frame.get());
    if (failure == AVERROR(ENOMEM)) throw std::bad_alloc();
    if (failure < 0) return damaged(failure);
    const bool is_known = frame->format == AV_PIX_FMT_RGB24 || frame->format == AV_PIX_FMT_PAL8;
    if (frame->width != width || frame->height != height || !is_known)
        return "is not the picture that its head tells of";
    write_rgb(*frame, rgb);
    return {};
}

} // namespace

} // namespace shadowproof

/// See pcx_entry.
extern "C" __attribute__((visibility("default"))) const shadowproof::PcxLibrary*
shadowproof_pcx_1() {
    static const shadowproof::PcxLibrary functions{shadowproof::decode};
    return &functions;
}
