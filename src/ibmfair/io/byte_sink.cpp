#include "ibmfair/io/byte_sink.h"

#include "ibmfair/io/numbers.h"

namespace ibmfair {

void ByteSink::write_real(double value) {
  char buffer[number_text_capacity];
  write(number_text(value, buffer));
}

void ByteSink::flush() {
  const std::string_view pending(buffer_.get(), used_);
  used_ = 0;
  pass_on(pending);
}

void ByteSink::pass_on(std::string_view bytes) {
  if (!bytes.empty()) {
    take(bytes);
    passed_on_ += static_cast<std::int64_t>(bytes.size());
  }
}

}  // namespace ibmfair
