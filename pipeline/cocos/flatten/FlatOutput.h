// The text that a stage becomes, line by line with the places it comes from.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

#include "cocos/flatten/Flattener.h"

namespace crevice::cocos {

class FlatOutput {
protected:
    using Origin = FlatSource::Origin;

    /// `call` is the author's macro call that writes the line, where one does.
    void write(std::string_view line, Origin origin, const std::optional<Origin>& call) {
        if (call && (origin.file != call->file || origin.line != call->line))
            out_.flat.calls.emplace(static_cast<int>(lineCount()) + 1, *call);
        out_.flat.text.append(line).push_back('\n');
        out_.flat.lines.push_back(origin);
    }

    std::uint32_t lineCount() const { return static_cast<std::uint32_t>(out_.flat.lines.size()); }

    std::uint32_t fileIndex(const std::string& file) {
        const auto [it, isNew] = fileIndices_.try_emplace(file, static_cast<std::uint32_t>(out_.flat.files.size()));
        if (isNew) out_.flat.files.push_back(file);
        return it->second;
    }

    SourceLoc placeAt(std::string_view line, std::size_t at, std::size_t length, Origin origin) const {
        return {out_.flat.files[origin.file], origin.line, int(std::min(at, line.size())) + 1, int(length)};
    }

    /// The whole line.
    SourceLoc place(std::string_view line, Origin origin) const {
        const auto begin = std::min(line.find_first_not_of(" \t"), line.size());
        return {out_.flat.files[origin.file], origin.line, static_cast<int>(begin) + 1,
                static_cast<int>(std::max<std::size_t>(1, std::min<std::size_t>(200, trimBlank(line).size())))};
    }

    Flattened out_;

private:
    std::unordered_map<std::string, std::uint32_t> fileIndices_;
};

}  // namespace crevice::cocos
