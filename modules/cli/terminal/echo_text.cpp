#include "cli/terminal/echo_text.hpp"

#include "cli/terminal/plain_numbers.hpp"

namespace priamos::cli {

std::string EchoText(const bus::Json& message, const std::vector<FieldPath>& fields, EchoForm form) {
  const bus::Json plain = WithPlainNumbers(message);
  const bool for_people = form == EchoForm::kForPeople;
  if (fields.empty()) return plain.dump(for_people ? 2 : -1);
  if (for_people && fields.size() == 1) return fields[0].In(plain).dump();
  auto some = bus::Json::object();
  for (const FieldPath& field : fields) some[field.text()] = field.In(plain);
  return some.dump();
}

}  // namespace priamos::cli
