// Writes the report of the sample study, for a browser to draw. Usage: sample_report FILE.html
#include <fstream>

#include "study/report/html.h"
#include "support/sample_study.h"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  std::ofstream file(argv[1], std::ios::binary);
  file << pellucid::study_html(pellucid::test::sample_study());
  return file.good() ? 0 : 1;
}
