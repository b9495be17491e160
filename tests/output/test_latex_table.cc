// Tables for LaTeX.
#include "unilateral/output/latex_table.h"

#include <gtest/gtest.h>

using namespace unilateral;

TEST(LatexTable, has_a_row_for_each_line)
{
  EXPECT_EQ(latex_table("level,error_L2\n0,0.125\n12,1.23456e-07\n"), "% \\usepackage{booktabs}\n"
                                                                      "\\begin{tabular}{rr}\n"
                                                                      "  \\toprule\n"
                                                                      "  \\texttt{level} & \\texttt{error\\_L2} \\\\\n"
                                                                      "  \\midrule\n"
                                                                      "  $0$ & $0.125$ \\\\\n"
                                                                      "  $12$ & $1.235\\cdot10^{-7}$ \\\\\n"
                                                                      "  \\bottomrule\n"
                                                                      "\\end{tabular}\n");
}

TEST(LatexTable, escapes_what_means_something_to_tex)
{
  const std::string table = latex_table("\"a,b\"\n\"50 % & \\ #1\"\n\n");
  EXPECT_NE(table.find("\\texttt{a,b}"), std::string::npos);
  EXPECT_NE(table.find("50 \\% \\& \\textbackslash{} \\#1"), std::string::npos);
  EXPECT_EQ(latex_table(""), "");
}
