#include "cli/terminal/echo_text.hpp"

#include "bus/schema/json_text.hpp"
#include "cli/terminal/plain_numbers.hpp"

namespace priamos::cli {

std::string EchoText(const bus::Json& message, const std::vector<FieldPath>& fields, EchoForm form) {
  const bus::Json plain = WithPlainNumbers(message);
  const bool for_people = form == EchoForm::kForPeople;
  if (fields.empty()) return for_people ? plain.dump(2) : bus::JsonText(plain);
  if (for_people && fields.size() == 1) return bus::JsonText(fields[0].In(plain));
  auto some = bus::Json::object();
  for (const FieldPath& field : fields) some[field.text()] = field.In(plain);
  return bus::JsonText(some);
}

}  // namespace priamos::cli
