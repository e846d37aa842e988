// What `effects compile` says: a line per pass and a summary, or everything as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "app/commands/MissingNames.h"
#include "core/Document.h"
#include "core/Log.h"
#include "effect/EffectLibrary.h"

namespace crevice {

class EffectReport {
public:
    EffectReport(bool json, bool text, const Log& log) : json_(json), text_(text), log_(log) {}

    void success(const VariantRequest& request, const EffectPass& pass, const EffectVariant& variant);
    /// Names the identifiers that the pass' source does not declare with these macros.
    void failure(const VariantRequest& request, const EffectPass& pass, const Error& error,
                 const std::vector<MissingName>& missing = {});
    /// An effect that could not even be taken apart.
    void unreadable(const std::string& effect, const std::string& message);
    /// One effect in Cocos' terms.
    void addReflection(const Value& effect);

    /// The summary, or the JSON: an array of passes; with `cocos` an object of passes, effects and counts.
    void finish(std::size_t effects, bool cocos) const;
    std::size_t failed() const { return failed_; }

private:
    using Json = nlohmann::ordered_json;
    void line(const VariantRequest& request, const EffectPass& pass, bool ok, const std::string& end) const;

    bool json_, text_;
    const Log& log_;
    std::size_t compiled_ = 0, failed_ = 0;
    std::size_t undeclared_ = 0;  ///< Of the failed: passes whose source lacks a declaration.
    Json passes_ = Json::array(), effects_ = Json::array();
};

}  // namespace crevice
