#include <fmt/format.h>
#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

#include "public_types.hpp"
#include "test/support/project_files.hpp"

// Who reads a header, or the API pages, is told of every type what it is.

namespace priamos {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<PublicType> TypesIn(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(PRIAMOS_SOURCE_DIR / file).rdbuf();
  return PublicTypesOf(text.str());
}

TEST(Docstrings, EveryPublicTypeHasOne) {
  std::size_t types = 0;
  std::vector<std::string> silent;
  for (const char* folder : {"lcmtypes", "bus", "modules"}) {
    for (const std::filesystem::path& file : ProjectFiles(folder)) {
      if (file.extension() != ".hpp") continue;
      for (const PublicType& type : TypesIn(file)) {
        ++types;
        if (!type.documented) silent.push_back(fmt::format("{}:{}: {}", file.string(), type.line, type.name));
      }
    }
  }
  EXPECT_GT(types, 500u);
  EXPECT_THAT(silent, IsEmpty())
      << "next: write before each, behind ///, in two words at least what it is, with unit and frame";
}

std::vector<std::string> Names(std::string_view header) {
  std::vector<std::string> names;
  for (const PublicType& type : PublicTypesOf(header))
    names.push_back(fmt::format("{} {}{}", type.line, type.name, type.documented ? "" : " silent"));
  return names;
}

TEST(PublicTypes, AreFoundWithTheirDocstrings) {
  EXPECT_THAT(Names("namespace a {\n"
                    "/// Is said.\n"
                    "struct One {};\n"
                    "\n"
                    "enum class Two : int { kA };  ///< behind it is too late for Doxygen\n"
                    "/// Is said.\n"
                    "template <class T>\n"
                    "class Three final : public Base<T> {};\n"
                    "///\n"
                    "struct Four {};\n"),
              ElementsAre("3 One", "5 Two silent", "7 Three", "10 Four silent"));
}

TEST(PublicTypes, WithAttributesAndSpecialisationsAreFound) {
  EXPECT_THAT(Names("struct alignas(8) A {};\n"
                    "class [[nodiscard]] B {};\n"
                    "template <>\nstruct C<int> {};\n"
                    "template <class T>\nclass D<std::vector<T>> final : public Base<T> {};\n"
                    "enum class [[nodiscard]] E : int { kA };\n"),
              ElementsAre("1 A silent", "2 B silent", "3 C silent", "5 D silent", "7 E silent"));
}

TEST(PublicTypes, OneWordIsNoDocstring) {
  EXPECT_THAT(Names("/// x\nstruct A {};\n/// Two words.\nstruct B {};\n"), ElementsAre("2 A silent", "4 B"));
}

TEST(PublicTypes, OfAClassAreThoseInItsPublicPart) {
  EXPECT_THAT(Names("class A {\n"
                    "  struct Hidden {};\n"
                    " public:\n"
                    "  struct Shown {};\n"
                    "  int value{0};\n"
                    " private:\n"
                    "  struct Secret { struct Within {}; };\n"
                    "};\n"
                    "struct B {\n"
                    "  struct Inner {};\n"
                    "};\n"),
              ElementsAre("1 A silent", "4 Shown silent", "9 B silent", "10 Inner silent"));
}

TEST(PublicTypes, AreNeitherDetailsNorDeclarationsNorPartsOfFunctions) {
  EXPECT_THAT(Names("class Declared;\n"
                    "namespace detail {\nstruct A {};\n}\nnamespace a::internal {\nstruct A {};\n}\n"
                    "namespace {\nstruct B {};\n}\n"
                    "inline void F(struct Declared* d) {\n  struct C {};\n}\n"
                    "// struct D {\n"
                    "const char* g = \"struct E {\";\n"
                    "constexpr int kMany = 1'000'000, kBrace = '{';\n"),
              IsEmpty());
}

}  // namespace
}  // namespace priamos
