# Compiles everything with the sanitizers that NURBSTRIM_SANITIZER names.
if (NURBSTRIM_SANITIZER STREQUAL "address")
  set(sanitizers
    -fsanitize=address,undefined,float-cast-overflow
    -fno-sanitize-recover=undefined,float-cast-overflow
    -D_GLIBCXX_ASSERTIONS)
elseif (NURBSTRIM_SANITIZER STREQUAL "thread")
  set(sanitizers -fsanitize=thread)
elseif (NURBSTRIM_SANITIZER)
  message(FATAL_ERROR "NURBSTRIM_SANITIZER is ${NURBSTRIM_SANITIZER}: give address or thread")
endif ()
if (NURBSTRIM_SANITIZER)
  add_compile_options(${sanitizers} -fno-omit-frame-pointer -g1)
  add_link_options(${sanitizers})
endif ()
