// One pass over the bytes: those above 0x7f belong to UTF-8 and stay.
#include "core/Controls.h"

namespace crevice {

std::string withoutControls(std::string text) {
    for (char& c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if ((byte < 0x20 && c != '\n' && c != '\t') || byte == 0x7f) c = '?';
    }
    return text;
}

}  // namespace crevice
