#include "bus/own_types.hpp"

namespace priamos::bus {

Schema OwnTypes(const std::vector<TypeText>& further) {
  std::vector<TypeText> texts = EmbeddedTypes();
  texts.insert(texts.end(), further.begin(), further.end());
  return Schema::FromTexts(texts);
}

}  // namespace priamos::bus
