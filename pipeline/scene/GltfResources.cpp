// Bytes that a glTF names: buffers and pictures, in files, URIs or the .glb. Nothing is read outside the allowed
// folders.
#include <algorithm>

#include <fmt/format.h>

#include "core/LimitedFiles.h"
#include "scene/GltfParts.h"

namespace crevice::gltf {

namespace fs = std::filesystem;

namespace {

// "http:", "file:" …: a scheme of RFC 3986, 3.1, of two letters or more (one is a drive of other systems).
bool hasScheme(std::string_view uri) {
    const std::size_t colon = uri.find(':');
    if (colon == std::string_view::npos || colon < 2) return false;
    return std::all_of(uri.begin(), uri.begin() + std::ptrdiff_t(colon), [](unsigned char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '+' || c == '-' ||
               c == '.';
    });
}

std::vector<fs::path> rootsOf(const LoadOptions& options, const fs::path& folder) {
    std::vector<fs::path> roots = options.allowedRoots;
    roots.insert(roots.begin(), folder);
    return roots;
}

}  // namespace

Resources::Resources(File& file, const fs::path& folder)
    : file_(file),
      folder_(folder),
      allowed_(rootsOf(file.options, folder)),
      bytesLeft_(file.options.limits.maxFileBytes) {}

std::span<const std::byte> Resources::keep(std::vector<std::byte> bytes) {
    return file_.storage.emplace_back(std::move(bytes));
}

// Throws Error when the place is not allowed.
fs::path Resources::placeOf(std::string_view list, std::size_t index, const std::string& uri) const {
    const std::string name = decodePercent(uri);
    if (name.empty()) file_.fail(list, index, "'uri' is empty");
    if (name.find('\0') != std::string::npos) file_.fail(list, index, "'uri' has a zero byte");
    const fs::path path = folder_ / name;
    if (!allowed_.contains(path))
        file_.fail(
            list, index, fmt::format("'{}' lies outside the scene's folder", name),
            "files are only read from the folder of the scene and below: copy it there, or allow its folder with "
            "--allow-path DIR");
    return path;
}

void Resources::checkDataUri(std::size_t index, const BufferPart& buffer) {
    const std::string_view type = std::string_view(buffer.uri).substr(5, buffer.uri.find_first_of(",;") - 5);
    if (type != "application/octet-stream" && type != "application/gltf-buffer")
        file_.fault("buffers", index, fmt::format("'uri' is data of type '{}'", type));
}

void Resources::readBuffer(std::size_t index, BufferPart& buffer) {
    if (!buffer.hasUri) {
        if (index == 0 && file_.hasBinaryChunk) {
            if (file_.binaryChunk.size() < buffer.byteLength)
                file_.fail("buffers", index,
                           fmt::format("the binary chunk has {} bytes, 'byteLength' says {}", file_.binaryChunk.size(),
                                       buffer.byteLength),
                           "the file may be truncated: export or download it again");
            buffer.bytes = file_.binaryChunk.first(buffer.byteLength);
            if (const std::size_t rest = file_.binaryChunk.size() - buffer.byteLength; rest > 3)  // more than padding
                file_.note(fmt::format("buffers[{}]: {} bytes of the binary chunk are left over", index, rest));
        } else if (file_.binary && !buffer.fallback) {
            file_.fail("buffers", index, "it has neither 'uri' nor a chunk of binary data");
        }
        return;
    }
    if (buffer.uri.starts_with("data:")) {
        checkDataUri(index, buffer);
        auto bytes = decodeDataUri(buffer.uri);
        if (!bytes || bytes->size() < buffer.byteLength)
            file_.fail("buffers", index,
                       fmt::format("'uri' does not hold the {} bytes of 'byteLength' as base64", buffer.byteLength));
        if (bytes->size() > buffer.byteLength)
            file_.fault("buffers", index,
                        fmt::format("'uri' holds {} bytes, 'byteLength' says {}", bytes->size(), buffer.byteLength));
        buffer.bytes = keep(std::move(*bytes)).first(buffer.byteLength);
        return;
    }
    if (hasScheme(buffer.uri))
        file_.fail("buffers", index, fmt::format("'{}' is not a file", buffer.uri.substr(0, 80)),
                   "copy the file beside the .gltf and name it there");
    const fs::path path = placeOf("buffers", index, buffer.uri).lexically_normal();
    const std::string shown = path.filename().string();
    const auto known = read_.find(path);
    std::span<const std::byte> bytes = known == read_.end() ? std::span<const std::byte>{} : known->second;
    if (known == read_.end()) {
        std::error_code error;
        const std::uintmax_t size = fs::file_size(path, error);
        if (error)
            file_.fail("buffers", index, fmt::format("cannot read '{}': {}", shown, error.message()),
                       "the geometry lives in that file: keep it beside the .gltf");
        if (size < buffer.byteLength)
            file_.fail("buffers", index,
                       fmt::format("'{}' has {} bytes, 'byteLength' says {}", shown, size, buffer.byteLength),
                       "the file may be truncated: export or download it again");
        bytes = keep(readBytesWithin(path, bytesLeft_));
        bytesLeft_ -= bytes.size();
        read_.emplace(path, bytes);
    }
    if (bytes.size() < buffer.byteLength)
        file_.fail("buffers", index,
                   fmt::format("'{}' has {} bytes, 'byteLength' says {}", shown, bytes.size(), buffer.byteLength),
                   "the file may be truncated: export or download it again");
    buffer.bytes = bytes.first(buffer.byteLength);
}

void Resources::readBuffers() {
    std::size_t total = 0;
    for (std::size_t i = 0; i < file_.model.buffers.size(); ++i) {
        total += std::min(file_.model.buffers[i].byteLength, file_.options.limits.maxFileBytes + 1);
        if (total > file_.options.limits.maxFileBytes)
            file_.fail(
                "buffers", i,
                fmt::format("the buffers are larger than the limit of {} bytes", file_.options.limits.maxFileBytes),
                raiseLimit("file-bytes"));
        readBuffer(i, file_.model.buffers[i]);
        file_.tell("reading", double(i + 1) / double(file_.model.buffers.size()));
    }
}

void Resources::readBufferViews() {
    const auto& buffers = file_.model.buffers;
    std::size_t decompressed = 0;
    for (std::size_t i = 0; i < file_.model.bufferViews.size(); ++i) {
        BufferViewPart& view = file_.model.bufferViews[i];
        const auto part = [&](int buffer, std::size_t offset, std::size_t length) -> std::span<const std::byte> {
            const BufferPart& from = buffers[std::size_t(buffer)];
            if (offset > from.byteLength || length > from.byteLength - offset)
                file_.fail("bufferViews", i,
                           fmt::format("'byteOffset' {} and 'byteLength' {} reach beyond buffers[{}] of {} bytes",
                                       offset, length, buffer, from.byteLength));
            if (from.bytes.empty()) return {};
            return from.bytes.subspan(offset, length);
        };
        view.bytes = part(view.buffer, view.byteOffset, view.byteLength);
        if (!view.compression) continue;
        const Compression& packed = *view.compression;
        decompressed += std::min(view.byteLength, file_.options.limits.maxFileBytes + 1);
        if (decompressed > file_.options.limits.maxFileBytes)
            file_.fail("bufferViews", i,
                       fmt::format("the decompressed views are larger than the limit of {} bytes",
                                   file_.options.limits.maxFileBytes),
                       raiseLimit("file-bytes"));
        view.bytes = keep(decompress(file_, i, part(packed.buffer, packed.byteOffset, packed.byteLength)));
    }
}

void Resources::readImages() {
    std::set<int> wanted;
    for (const TexturePart& texture : file_.model.textures) wanted.insert({texture.source, texture.webp});
    for (std::size_t i = 0; i < file_.model.images.size(); ++i) {
        ImagePart& image = file_.model.images[i];
        if (image.bufferView >= 0) {
            image.bytes = file_.model.bufferViews[std::size_t(image.bufferView)].bytes;
            continue;
        }
        if (!wanted.contains(int(i))) continue;
        if (image.uri.starts_with("data:")) {
            auto bytes = decodeDataUri(image.uri);
            if (bytes) image.bytes = keep(std::move(*bytes));
            continue;
        }
        if (hasScheme(image.uri)) {
            file_.lack("images", i, fmt::format("'{}' is not a file: shown white", image.uri.substr(0, 80)));
            continue;
        }
        if (image.uri.empty()) continue;
        const fs::path path = placeOf("images", i, image.uri).lexically_normal();
        if (const auto known = read_.find(path); known != read_.end()) {
            image.bytes = known->second;
            continue;
        }
        std::error_code error;
        if (!fs::is_regular_file(path, error)) {
            file_.lack("images", i, fmt::format("no file '{}': shown white", path.filename().string()));
            continue;
        }
        image.bytes = keep(readBytesWithin(path, bytesLeft_));
        bytesLeft_ -= image.bytes.size();
        read_.emplace(path, image.bytes);
    }
}

}  // namespace crevice::gltf
