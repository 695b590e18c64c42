// packaging/write_pages.cpp: `softscope_pages FOLDER`: man pages and completions as files.
#include <cstdio>
#include <fstream>

#include "core/error.h"
#include "packaging/completions.h"
#include "packaging/man_page.h"
#include "toolkit/record/version.h"

namespace softscope {
namespace {

void write(const std::string& file, const std::string& text) {
  std::ofstream out(file);
  out << text;
  if (!out.flush()) throw Error(file + ": can't be written. Does its folder exist?");
}

void writePages(const std::string& folder) {
  const std::vector<ListedCommand> commands = listCommands();
  write(folder + "/softscope.1", overviewPage(commands, versionText()));
  for (const ListedCommand& listed : commands)
    write(folder + "/softscope-" + listed.command->name() + ".1",
          commandPage(listed, versionText()));
  write(folder + "/softscope.bash", bashCompletion(commands));
  write(folder + "/_softscope", zshCompletion(commands));
  write(folder + "/softscope.fish", fishCompletion(commands));
}

}  // namespace
}  // namespace softscope

int main(int count, char** words) {
  if (count != 2) return std::fputs("usage: softscope_pages FOLDER\n", stderr), 2;
  try {
    softscope::writePages(words[1]);
  } catch (const std::exception& error) {
    return std::fprintf(stderr, "%s\n", error.what()), 3;
  }
  return 0;
}
