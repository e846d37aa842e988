// The tables behind the names: enum orders are those of Cocos' gfx layer (Type and Format).
#include "cocos/interface/GlslTypes.h"

#include <map>
#include <string>

namespace crevice::cocos {
namespace {

using Table = std::map<std::string, GlslType, std::less<>>;

/// Scalars and vectors: `scalar`, PREFIXvec2…4.
void addVectors(Table& table, const std::string& scalar, const std::string& prefix, GlslType type, int format) {
    static constexpr int kStep[] = {0, 10, 21, 33};  // R32F 11, RG32F 21, RGB32F 32, RGBA32F 44; the same for I and UI
    for (int i = 1; i <= 4; ++i) {
        GlslType entry = type;
        entry.components = i;
        if (type.type != 0) entry.type = type.type + i - 1;
        if (format != 0) entry.attributeFormat = format + kStep[i - 1];
        table[i == 1 ? scalar : prefix + "vec" + std::to_string(i)] = entry;
    }
}

void addMatrices(Table& table, const std::string& prefix, int componentBytes) {
    static constexpr int kType[3][3] = {{17, 18, 19}, {20, 21, 22}, {23, 24, 25}};  // MAT2 … MAT4, [columns][rows]
    for (int columns = 2; columns <= 4; ++columns) {
        for (int rows = 2; rows <= 4; ++rows) {
            GlslType entry{kType[columns - 2][rows - 2], 0, rows, columns, componentBytes, componentBytes == 8, {}};
            if (componentBytes == 4) entry.attributeFormat = 44;
            const std::string size = std::to_string(columns);
            table[prefix + "mat" + size + "x" + std::to_string(rows)] = entry;
            if (columns == rows) table[prefix + "mat" + size] = entry;
        }
    }
}

void addResources(Table& table) {
    struct Shape {
        const char* name;
        int combined, texture, image;  // Cocos' numbers; shapes that it has none for are 0
    };
    static constexpr Shape kShapes[] = {{"1D", 26, 33, 39},      {"1DArray", 27, 34, 40}, {"2D", 28, 35, 41},
                                        {"2DArray", 29, 36, 42}, {"3D", 30, 37, 43},      {"Cube", 31, 38, 44},
                                        {"2DMS", 0, 0, 0},       {"CubeArray", 0, 0, 0},  {"2DMSArray", 0, 0, 0},
                                        {"Buffer", 0, 0, 0},     {"2DRect", 0, 0, 0}};
    const auto resource = [](int type, InterfaceKind kind) {
        GlslType entry;
        entry.type = type;
        entry.resource = kind;
        return entry;
    };
    for (const char* prefix : {"", "i", "u"}) {
        const std::string p = prefix;
        for (const Shape& shape : kShapes) {
            table[p + "sampler" + shape.name] = resource(shape.combined, InterfaceKind::CombinedSampler);
            table[p + "texture" + shape.name] = resource(shape.texture, InterfaceKind::Texture);
            table[p + "image" + shape.name] = resource(shape.image, InterfaceKind::Image);
        }
        table[p + "subpassInput"] = resource(45, InterfaceKind::SubpassInput);
        table[p + "subpassInputMS"] = resource(45, InterfaceKind::SubpassInput);
    }
    for (const char* shape : {"1D", "2D", "Cube", "1DArray", "2DArray", "CubeArray", "2DRect"}) {
        const GlslType& plain = table.at(std::string("sampler") + shape);
        table[std::string("sampler") + shape + "Shadow"] = plain;
    }
    table["sampler"] = resource(32, InterfaceKind::Sampler);
    table["samplerShadow"] = resource(32, InterfaceKind::Sampler);
}

Table makeTable() {
    Table table;
    const auto scalar = [](int type, int bytes, bool integer) {
        GlslType entry;
        entry.type = type;
        entry.componentBytes = bytes;
        entry.integer = integer;
        return entry;
    };
    addVectors(table, "bool", "b", scalar(1, 4, true), 0);
    addVectors(table, "int", "i", scalar(5, 4, true), 13);
    addVectors(table, "uint", "u", scalar(9, 4, true), 12);
    addVectors(table, "float", "", scalar(13, 4, false), 11);
    addVectors(table, "double", "d", scalar(0, 8, true), 0);
    // The explicit types of GL_EXT_shader_explicit_arithmetic_types: Cocos' tables do not know them.
    addVectors(table, "int32_t", "i32", scalar(0, 4, true), 0);
    addVectors(table, "uint32_t", "u32", scalar(0, 4, true), 0);
    addVectors(table, "int16_t", "i16", scalar(0, 2, true), 0);
    addVectors(table, "uint16_t", "u16", scalar(0, 2, true), 0);
    addVectors(table, "int8_t", "i8", scalar(0, 1, true), 0);
    addVectors(table, "uint8_t", "u8", scalar(0, 1, true), 0);
    addVectors(table, "float32_t", "f32", scalar(0, 4, false), 0);
    addVectors(table, "float16_t", "f16", scalar(0, 2, false), 0);
    addMatrices(table, "", 4);
    addMatrices(table, "d", 8);
    addResources(table);
    return table;
}

}  // namespace

const GlslType* findGlslType(std::string_view name) {
    static const Table table = makeTable();
    const auto it = table.find(name);
    return it == table.end() ? nullptr : &it->second;
}

NamedFormat findFormat(std::string_view name) {
    // In the order of Cocos' enum, from UNKNOWN 0 on.
    static constexpr const char* kNames[] = {
        "UNKNOWN", "A8",      "L8",       "LA8",     "R8",      "R8SN",     "R8UI",   "R8I",      "R16F",    "R16UI",
        "R16I",    "R32F",    "R32UI",    "R32I",    "RG8",     "RG8SN",    "RG8UI",  "RG8I",     "RG16F",   "RG16UI",
        "RG16I",   "RG32F",   "RG32UI",   "RG32I",   "RGB8",    "SRGB8",    "RGB8SN", "RGB8UI",   "RGB8I",   "RGB16F",
        "RGB16UI", "RGB16I",  "RGB32F",   "RGB32UI", "RGB32I",  "RGBA8",    "BGRA8",  "SRGB8_A8", "RGBA8SN", "RGBA8UI",
        "RGBA8I",  "RGBA16F", "RGBA16UI", "RGBA16I", "RGBA32F", "RGBA32UI", "RGBA32I"};
    for (int i = 1; i < static_cast<int>(std::size(kNames)); ++i) {
        if (name != kNames[i]) continue;
        const bool real = name.ends_with("F"), integer = name.ends_with("I");
        return {i, !real && !integer};
    }
    return {};
}

}  // namespace crevice::cocos
