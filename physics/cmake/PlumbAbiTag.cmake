# A library built from other public headers than its user's may lay out every type differently.
# The tag makes that a link error instead of undefined behaviour.

# Digits of the headers' text that go into the name: 12 hexadecimal ones are 48 bits, so two versions
# share them by a chance of 1 in 10^14.
set(PLUMB_ABI_TAG_DIGITS 12)

# Writes the header <out> (abi_tag.h.in) that names the text of the given public headers.
#   plumb_write_abi_tag(<out> <header>...)
function(plumb_write_abi_tag out)
  set(digests "")
  foreach(header IN LISTS ARGN)
    file(SHA256 "${header}" digest)
    string(APPEND digests ${digest})
  endforeach()
  string(SHA256 headers_hash "${digests}")
  string(SUBSTRING ${headers_hash} 0 ${PLUMB_ABI_TAG_DIGITS} headers_hash)
  configure_file("${CMAKE_CURRENT_FUNCTION_LIST_DIR}/abi_tag.h.in" "${out}" @ONLY)
endfunction()
