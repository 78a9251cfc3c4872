// Well formatted, compiles, and breaks one check of every family in the configuration on the lines marked, so that
// a family that is silently dropped is noticed.
#include <string>
#include <vector>

namespace isojam {

int calls = 0;  // expect cppcoreguidelines-avoid-non-const-global-variables

double mean_volume(int total, int count) { return total / count; }  // expect bugprone-integer-division

std::string name_of(std::string name) { return name + "!"; }  // expect performance-unnecessary-value-param

int* first_free() { return 0; }  // expect modernize-use-nullptr

bool is_empty(const std::vector<int>& values) { return values.size() == 0; }  // expect readability-container-size-empty

int BadlyNamed() { return 1; }  // expect readability-identifier-naming

struct Length {
  Length(double value) : value_(value) {}  // expect google-explicit-constructor
  double value_;
};

bool is_itself(int x) { return x == x; }  // expect misc-redundant-expression

int sum_to(int last) {
  int sum = 0;
  for (float x = 0; x < 1; x += 0.1F) sum = last;  // expect cert-flp30-c
  return sum;
}

int null_read() {
  const int* nowhere = nullptr;
  return *nowhere;  // expect clang-analyzer-core.NullDereference
}

int one_line_too_long(int x) {  // expect readability-function-size
  x += 1;
  x += 2;
  x += 3;
  x += 4;
  x += 5;
  x += 6;
  x += 7;
  x += 8;
  x += 9;
  x += 10;
  x += 11;
  x += 12;
  x += 13;
  x += 14;
  x += 15;
  x += 16;
  x += 17;
  x += 18;
  x += 19;
  x += 20;
  x += 21;
  x += 22;
  x += 23;
  x += 24;
  x += 25;
  x += 26;
  x += 27;
  x += 28;
  x += 29;
  x += 30;
  x += 31;
  x += 32;
  x += 33;
  x += 34;
  x += 35;
  x += 36;
  x += 37;
  x += 38;
  x += 39;
  x += 40;
  x += 41;
  x += 42;
  x += 43;
  x += 44;
  x += 45;
  x += 46;
  x += 47;
  x += 48;
  x += 49;
  x += 50;
  x += 51;
  x += 52;
  x += 53;
  x += 54;
  x += 55;
  x += 56;
  x += 57;
  x += 58;
  x += 59;
  return x;
}

}  // namespace isojam
