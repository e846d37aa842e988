// Reads the YAML of a CCEffect block: techniques, passes, properties.
#pragma once

#include "core/Document.h"
#include "effect/EffectAsset.h"

namespace crevice {

/// Fills `effect.techniques` from the parsed header.
void readEffectHeader(const Value& header, EffectAsset& effect, EffectReading reading, Problems& problems);

/// An object that is read key by key. finish() reports the keys nobody asked for, unless the reading is tolerant.
class KeyReader {
public:
    KeyReader(const Value& object, std::string what, EffectReading reading, Problems& problems);

    /// The value of a key, or null. The key counts as known from now on.
    const Value* find(const char* key);
    /// As find(), but another type than the one asked for is an error and gives null.
    const Value* string(const char* key);
    const Value* number(const char* key);
    const Value* boolean(const char* key);
    const Value* array(const char* key);
    const Value* object(const char* key);
    void finish();

    const std::string& what() const { return what_; }
    bool strict() const { return reading_ == EffectReading::Strict; }
    EffectReading reading() const { return reading_; }
    Problems& problems() { return problems_; }

private:
    const Value* typed(const char* key, bool (Value::*is)() const, const char* wanted);

    const Value& object_;
    std::string what_;
    EffectReading reading_;
    Problems& problems_;
    std::vector<std::string> known_;
};

}  // namespace crevice
