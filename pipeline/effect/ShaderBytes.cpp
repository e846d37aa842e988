// Numbers in the machine's byte order, texts and lists with their length in front.
#include "effect/ShaderBytes.h"

#include <cstring>
#include <type_traits>

namespace crevice {
namespace {

constexpr std::uint32_t kSpirvMagic = 0x07230203;

class ByteWriter {
public:
    template <class T>
    void operator()(T value) requires std::is_arithmetic_v<T> || std::is_enum_v<T> {
        bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    void operator()(const std::string& text) {
        (*this)(static_cast<std::uint32_t>(text.size()));
        bytes += text;
    }
    void operator()(const std::vector<std::uint32_t>& words) {
        (*this)(static_cast<std::uint32_t>(words.size()));
        bytes.append(reinterpret_cast<const char*>(words.data()), words.size() * sizeof(std::uint32_t));
    }
    template <class T, class Each>
    void list(const std::vector<T>& items, Each each) {
        (*this)(static_cast<std::uint32_t>(items.size()));
        for (const T& item : items) each(*this, item);
    }
    std::string bytes;
};

/// Reads back in the same order. After damage everything reads as zero and empty.
class ByteReader {
public:
    explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

    template <class T>
    void operator()(T& value) requires std::is_arithmetic_v<T> || std::is_enum_v<T> {
        if (!take(&value, sizeof value)) value = T{};
    }
    void operator()(std::string& text) {
        text.resize(count(1));
        if (!take(text.data(), text.size())) text.clear();
    }
    void operator()(std::vector<std::uint32_t>& words) {
        words.resize(count(sizeof(std::uint32_t)));
        if (!take(words.data(), words.size() * sizeof(std::uint32_t))) words.clear();
    }
    template <class T, class Each>
    void list(std::vector<T>& items, Each each) {
        items.resize(count(kLeastBytes));
        for (T& item : items) each(*this, item);
    }
    bool complete() const { return !failed_ && rest_.empty(); }

private:
    static constexpr std::size_t kLeastBytes = 8;  ///< Of an item of any list.

    bool take(void* to, std::size_t bytes) {
        failed_ = failed_ || rest_.size() < bytes;
        if (failed_) return false;
        if (bytes != 0) std::memcpy(to, rest_.data(), bytes);
        rest_.remove_prefix(bytes);
        return true;
    }
    /// A count can be no larger than the bytes that are left allow.
    std::size_t count(std::size_t bytesEach) {
        std::uint32_t value = 0;
        (*this)(value);
        if (std::size_t(value) * bytesEach > rest_.size()) failed_ = true;
        return failed_ ? 0 : value;
    }

    std::string_view rest_;
    bool failed_ = false;
};

// One function for both directions: `Io` is the writer with const values or the reader.
template <class Io, class Loc>
void place(Io& io, Loc& loc) {
    io(loc.file), io(loc.line), io(loc.column), io(loc.length);
}

template <class Io, class Variable>
void variable(Io& io, Variable& v) {
    io(v.name), io(v.location), io(v.type), io(v.active);
}

template <class Io, class Resource>
void resource(Io& io, Resource& r) {
    io(r.name), io(r.kind), io(r.slot.set), io(r.slot.binding), io(r.count), io(r.stages);
    io(r.active), io(r.cube), io(r.readOnly), io(r.writeOnly), io(r.size);
    io.list(r.members, [](Io& inner, auto& m) {
        inner(m.name), inner(m.offset), inner(m.size), inner(m.type), inner(m.arrayCount), inner(m.arrayStride);
    });
    place(io, r.where);
    place(io, r.firstUse);
}

template <class Io, class List>
void problemList(Io& io, List& problems) {
    io.list(problems,
            [](Io& inner, auto& p) { inner(p.severity), place(inner, p.where), inner(p.message), inner(p.help); });
}

template <class Io, class Pass>
void compiledPass(Io& io, Pass& pass) {
    io.list(pass.code, [](Io& inner, auto& stage) { inner(stage.stage), inner(stage.words); });
    io.list(pass.info.resources, [](Io& inner, auto& r) { resource(inner, r); });
    io.list(pass.info.inputs, [](Io& inner, auto& v) { variable(inner, v); });
    io.list(pass.info.outputs, [](Io& inner, auto& v) { variable(inner, v); });
    for (auto& size : pass.info.localSize) io(size);
    io(pass.checked);
    problemList(io, pass.info.refusals);
    problemList(io, pass.remarks);
}

}  // namespace

std::string toBytes(const CompiledPass& pass) {
    ByteWriter writer;
    compiledPass(writer, pass);
    return std::move(writer.bytes);
}

std::optional<CompiledPass> compiledPassFrom(std::string_view bytes) {
    ByteReader reader(bytes);
    CompiledPass pass;
    compiledPass(reader, pass);
    if (!reader.complete() || pass.code.empty()) return std::nullopt;
    for (const StageCode& stage : pass.code)
        if (stage.words.empty() || stage.words[0] != kSpirvMagic) return std::nullopt;
    return pass;
}

std::string toBytes(const std::vector<Problem>& problems) {
    ByteWriter writer;
    problemList(writer, problems);
    return std::move(writer.bytes);
}

std::optional<std::vector<Problem>> problemsFrom(std::string_view bytes) {
    ByteReader reader(bytes);
    std::vector<Problem> problems;
    problemList(reader, problems);
    if (!reader.complete()) return std::nullopt;
    return problems;
}

}  // namespace crevice
