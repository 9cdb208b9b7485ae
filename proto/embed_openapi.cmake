# INPUT, a JSON file, becomes OUTPUT, a C++ source with proto/openapi.h's function.
file(READ ${INPUT} text)
file(
  WRITE ${OUTPUT}
  "#include \"proto/openapi.h\"

namespace subdivd::proto {

std::string_view openapi_json() {
  static constexpr std::string_view text = R\"openapi(${text})openapi\";
  return text;
}

}  // namespace subdivd::proto
")
