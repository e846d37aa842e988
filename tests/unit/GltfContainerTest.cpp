// The container of .glb files: headers, chunks and their lengths; JSON that is none. Codes: see GltfFaultCases.h.
#include <webp/encode.h>

#include "GltfFaultCases.h"
#include "GltfTestTools.h"

namespace crevice {
namespace {

using test::Answer;
using test::append;
using test::contains;
using test::GltfText;
using test::Listener;
using test::TempFolder;

constexpr std::uint32_t kJson = 0x4e4f534a, kBinary = 0x004e4942, kUnknown = 0x31323334;

std::string words(std::initializer_list<std::uint32_t> values) {
    std::vector<unsigned char> bytes;
    append<std::uint32_t>(bytes, values);
    return {bytes.begin(), bytes.end()};
}

std::string chunk(std::uint32_t type, const std::string& content) {
    return words({std::uint32_t(content.size()), type}) + content;
}

std::string padded(std::string text, char with = ' ') {
    while (text.size() % 4) text += with;
    return text;
}

std::string file(const std::string& chunks, std::uint32_t version = 2, int longer = 0) {
    return words({0x46546c67, version, std::uint32_t(12 + int(chunks.size()) + longer)}) + chunks;
}

const GltfText& square() {
    static const GltfText kSquare;
    return kSquare;
}
std::string json() {
    GltfText text = square();
    text.accessors.replace(text.accessors.find("\"VEC3\""), 6, R"("VEC3", "min": [0, 0, 0], "max": [1, 1, 0])");
    return padded(text.json(true));
}
std::string bytes() { return {square().bytes.begin(), square().bytes.end()}; }

struct ContainerCase {
    const char* code;
    Answer answer;
    std::string content;
    const char* says;
};

void expectAnswer(const ContainerCase& fault, const char* name) {
    SCOPED_TRACE(std::string(fault.code) + ": " + fault.says);
    const TempFolder folder;
    const auto path = folder.write(name, fault.content);
    for (const bool strict : {false, true}) {
        Listener listener;
        const std::string error = test::errorOf([&] { loadGltf(path, {.log = listener.log, .strict = strict}); });
        const bool refused = fault.answer == Answer::Refused || (strict && fault.answer == Answer::Fault);
        EXPECT_EQ(error != "no error", refused) << error;
        EXPECT_TRUE(contains(refused ? error : listener.text, fault.says)) << error << listener.text;
        EXPECT_TRUE(!refused || contains(error, name)) << error;
        EXPECT_TRUE(fault.answer != Answer::Silent || listener.text.empty()) << listener.text;
    }
}

TEST(GltfContainer, EveryFaultOfTheContainerIsAnswered) {
    using enum Answer;
    const std::string head = chunk(kJson, json()), whole = file(head + chunk(kBinary, bytes()));
    const std::string unaligned = json() + " ";
    const std::string external = padded(square().json());
    const ContainerCase cases[] = {
        {"", Silent, whole, ""},
        {"GLB_CHUNK_LENGTH_UNALIGNED", Fault, file(chunk(kJson, unaligned) + chunk(kBinary, bytes())),
         "the length of chunk 0 is not a multiple of 4"},
        {"GLB_CHUNK_TOO_BIG", Refused, file(words({5000, kJson}) + json()), "chunk 0 reaches beyond the file"},
        {"GLB_CHUNK_TOO_BIG", Refused, file(head + words({0xffffffff, kBinary}) + bytes()), "chunk 1 reaches beyond"},
        {"GLB_DUPLICATE_CHUNK", Refused, file(head + head), "it has two JSON chunks"},
        {"GLB_DUPLICATE_CHUNK", Refused, file(head + chunk(kBinary, bytes()) + chunk(kBinary, bytes())),
         "it has two chunks of binary data"},
        {"GLB_EMPTY_BIN_CHUNK", Silent,
         file(chunk(kJson, padded(R"({"asset": {"version": "2.0"}})")) + chunk(kBinary, "")), ""},
        {"GLB_EMPTY_CHUNK", Refused, file(chunk(kJson, "")), "its JSON chunk is empty"},
        {"GLB_EXTRA_DATA", Fault, whole + "more", "4 bytes follow the end of the .glb"},
        {"GLB_INVALID_MAGIC", Refused, "GLTF" + whole.substr(4), "it begins neither as JSON nor as a .glb"},
        {"GLB_INVALID_VERSION", Refused, file(head + chunk(kBinary, bytes()), 3), "container version 3 is not 2"},
        {"GLB_INVALID_VERSION", Refused, file(head, 1), "this is glTF 1.0"},
        {"GLB_LENGTH_MISMATCH", Refused, file(head + chunk(kBinary, bytes()), 2, 4), "bytes, the file has"},
        {"GLB_LENGTH_TOO_SMALL", Refused, file(head, 2, 16 - 12 - int(head.size())), "its header says 16 bytes"},
        {"GLB_UNEXPECTED_BIN_CHUNK", Fault, file(head + chunk(kUnknown, "1234") + chunk(kBinary, bytes())),
         "the chunk of binary data is not the second one"},
        {"GLB_UNEXPECTED_END_OF_CHUNK_DATA", Refused, file(head + words({8, kBinary}) + "1234"),
         "chunk 1 reaches beyond"},
        {"GLB_UNEXPECTED_END_OF_CHUNK_HEADER", Refused, file(head + "1234"), "chunk 1 has no header"},
        {"GLB_UNEXPECTED_END_OF_HEADER", Refused, whole.substr(0, 11), "11 bytes are less than its header"},
        {"GLB_UNEXPECTED_FIRST_CHUNK", Refused, file(chunk(kBinary, bytes()) + head), "the first chunk is not JSON"},
        {"GLB_UNKNOWN_CHUNK_TYPE", Silent, file(head + chunk(kBinary, bytes()) + chunk(kUnknown, "1234")), ""},
        {"BUFFER_MISSING_GLB_DATA", Refused, file(head), "buffers[0]: it has neither 'uri' nor a chunk of binary data"},
        {"BUFFER_BYTE_LENGTH_MISMATCH", Refused, file(head + chunk(kBinary, bytes().substr(8))),
         "buffers[0]: the binary chunk has 48 bytes, 'byteLength' says 56"},
        {"BUFFER_GLB_CHUNK_TOO_BIG", Told, file(head + chunk(kBinary, bytes() + "12345678")),
         "buffers[0]: 8 bytes of the binary chunk are left over"},
        {"INVALID_JSON", Refused, file(chunk(kJson, "{]  ") + chunk(kBinary, bytes())), "error:"},
        {"INVALID_JSON", Fault, file(chunk(kJson, "\xef\xbb\xbf " + json()) + chunk(kBinary, bytes())),
         "the JSON begins with a byte order mark"},
    };
    for (const ContainerCase& fault : cases) expectAnswer(fault, "t.glb");
    // Bytes in a data URI are legal here as well.
    GltfText text;
    text.accessors.replace(text.accessors.find("\"VEC3\""), 6, R"("VEC3", "min": [0, 0, 0], "max": [1, 1, 0])");
    expectAnswer({"DATA_URI_GLB", Silent, file(chunk(kJson, padded(text.json()))), ""}, "t.glb");
}

TEST(GltfContainer, WhatIsNoJsonIsRefusedWithItsPlace) {
    using enum Answer;
    const ContainerCase cases[] = {
        {"INVALID_JSON", Refused, "", "t.gltf"},
        {"INVALID_JSON", Refused, "[]", "the glTF must be an object, found a list"},
        {"INVALID_JSON", Refused, "{\"asset\": {\"version\": \"2.0\"}", "t.gltf:1:"},
        {"INVALID_JSON", Refused, "{\"asset\": {\"version\": \"2.0\"}} x", "t.gltf:1:"},
        {"INVALID_JSON", Refused, "{\"asset\": {\"version\": \"2.0\"}, \"x\": NaN}", "t.gltf:1:"},
        {"INVALID_JSON", Refused, "{\"asset\": {\"version\": \"2.0\"}, \"x\": \"\xff\"}", "t.gltf:1:"},
        {"INVALID_JSON", Refused, std::string("{\"asset\": \0 {\"version\": \"2.0\"}}", 32), "t.gltf:1:"},
        {"INVALID_JSON", Refused, std::string(100000, '['), "t.gltf:1:"},
    };
    for (const ContainerCase& fault : cases) expectAnswer(fault, "t.gltf");
}

// Specification, 2.7: keys should be unique; a later value overrides the one before.
TEST(GltfContainer, OfRepeatedKeysTheLastCounts) {
    using enum Answer;
    const char* says = "key 'version' stands twice in an object: the last value counts";
    const char* object = R"({"asset": {"version": "1.0", "version": "2.0"}})";
    expectAnswer({"INVALID_JSON", Fault, object, says}, "t.gltf");
    expectAnswer({"INVALID_JSON", Refused, R"({"asset": {"version": "2.0", "version": "1.0"}})", "t.gltf"}, "t.gltf");
    GltfText text;
    text.nodes =
        R"({"mesh": 7, "translation": [1, 0, 0], "mesh": 0, "translation": [0, 2, 0], "translation": [0, 0, 3]})";
    const Scene scene = text.load();
    EXPECT_EQ(glm::vec3(scene.instances.at(0).world[3]), glm::vec3(0, 0, 3));
    expectAnswer({"INVALID_JSON", Fault,
                  file(chunk(kJson, padded(R"({"asset": {"version": "2.0"}, "scenes": [], "scenes": [{}]})"))),
                  "key 'scenes' stands twice"},
                 "t.glb");
}

// IMAGE_NON_ENABLED_MIME_TYPE: WebP is read all the same.
TEST(GltfContainer, WebpNeedsItsExtension) {
    const std::uint8_t pixels[] = {255, 0, 0, 255};
    std::uint8_t* encoded = nullptr;
    const std::size_t size = WebPEncodeLosslessRGBA(pixels, 1, 1, 4, &encoded);
    const std::vector<unsigned char> picture(encoded, encoded + size);
    WebPFree(encoded);
    GltfText text;
    text.primitive = R"(, "indices": 1, "material": 0)";
    text.rest = R"(, "materials": [{"emissiveTexture": {"index": 0}}], "textures": [{"source": 0}],
        "images": [{"uri": "data:image/webp;base64,)" +
                test::encodeBase64(picture) + R"("}])";
    Listener listener;
    EXPECT_EQ(text.load(&listener).textures.size(), 1u);
    EXPECT_TRUE(contains(listener.text, "images[0]: it is WebP, but 'EXT_texture_webp' is not in 'extensionsUsed'"))
        << listener.text;
}

}  // namespace
}  // namespace crevice
