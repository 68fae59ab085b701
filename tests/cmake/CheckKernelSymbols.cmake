# Proves that the wide kernels share no inline function with the rest of the library: in the object
# files that are compiled for newer processors, every symbol that the linker may merge with another
# file's carries the name of its vector length. Otherwise it could keep their copy for everyone.
#   cmake -DNM=... -DOBJECTS=a.o;b.o -P CheckKernelSymbols.cmake
set(looked_at 0)
foreach(object IN LISTS OBJECTS)
  if(NOT object MATCHES "contact_wide_([0-9]+)\\.cpp")
    continue()
  endif()
  set(bits ${CMAKE_MATCH_1})
  execute_process(COMMAND "${NM}" -C "${object}" OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[^\n]+ [WVu] [^\n]+" weak "${symbols}")
  foreach(symbol IN LISTS weak)
    if(NOT symbol MATCHES "_v${bits}")
      message(SEND_ERROR "${object}: shared symbol ${symbol}")
    endif()
  endforeach()
  math(EXPR looked_at "${looked_at} + 1")
endforeach()
if(NOT looked_at EQUAL 3)
  message(SEND_ERROR "expected three wide kernels, found ${looked_at}")
endif()
