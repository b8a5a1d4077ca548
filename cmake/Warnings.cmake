# One interface target that carries warnings, sanitizers and the floating-point contract of host code.
add_library(pellucid_options INTERFACE)
target_compile_options(pellucid_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wno-unused-parameter
  # The kernel core is compiled for the host too (the twin); contraction would change its rounding.
  -ffp-contract=off)
option(PELLUCID_WERROR "Warnings are errors" OFF)
if(PELLUCID_WERROR)
  target_compile_options(pellucid_options INTERFACE -Werror)
endif()
if(PELLUCID_SANITIZE)
  # A report ends the program: tests must not pass over it.
  target_compile_options(pellucid_options INTERFACE
    -fsanitize=${PELLUCID_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(pellucid_options INTERFACE -fsanitize=${PELLUCID_SANITIZE})
endif()
