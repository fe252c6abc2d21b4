# The plain comment that a header opens with, as documentation of the file; and <V_ex> is no HTML.
{ gsub(/<V_ex>/, "\342\237\250V_ex\342\237\251") }
FNR == 1 && /^\/\/ / { print "/// \\file"; opening = 1 }
opening && /^\/\// { sub(/^\/\//, "///"); print; next }
{ opening = 0; print }
