#include "unilateral/report/report_page.h"

// UNILATERAL_PAGE_FOLDER: report/page/dist. The assembler puts the files as they are into the program.
asm(".section .rodata\n"
    ".global unilateral_report_script\nunilateral_report_script:\n.incbin \"" UNILATERAL_PAGE_FOLDER "/report.js\"\n"
    ".global unilateral_report_script_end\nunilateral_report_script_end:\n.byte 0\n"
    ".global unilateral_report_style\nunilateral_report_style:\n.incbin \"" UNILATERAL_PAGE_FOLDER "/report.css\"\n"
    ".global unilateral_report_style_end\nunilateral_report_style_end:\n.byte 0\n"
    ".text\n");

extern "C"
{
  extern const char unilateral_report_script[], unilateral_report_script_end[], unilateral_report_style[], unilateral_report_style_end[];
}

namespace unilateral
{
  std::string_view report_script()
  {
    return {unilateral_report_script, std::size_t(unilateral_report_script_end - unilateral_report_script)};
  }

  std::string_view report_style()
  {
    return {unilateral_report_style, std::size_t(unilateral_report_style_end - unilateral_report_style)};
  }
} // namespace unilateral
