#include "commands/page/page_template.h"

#ifdef IBMFAIR_REPORT_PAGE_FILE
// NOLINTNEXTLINE(hicpp-no-assembler): compilers take minutes for an array of this size
asm(".pushsection .rodata, \"a\", @progbits\n"
    "ibmfair_page_begin: .incbin \"" IBMFAIR_REPORT_PAGE_FILE
    "\"\n"
    "ibmfair_page_end: .byte 0\n"
    ".popsection\n");
extern "C" {
extern const char ibmfair_page_begin, ibmfair_page_end;
}
#endif

namespace ibmfair::commands {

std::string_view page_template() {
#ifdef IBMFAIR_REPORT_PAGE_FILE
  return {&ibmfair_page_begin, static_cast<std::size_t>(&ibmfair_page_end - &ibmfair_page_begin)};
#else
  return {};
#endif
}

}  // namespace ibmfair::commands
