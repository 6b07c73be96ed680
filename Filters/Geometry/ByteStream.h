/**
 * @file ByteStream.h
 * @brief Plain values to bytes and back, for what goes to another process of the same
 * program, through a pipe or to another rank.
 */
#ifndef ByteStream_h
#define ByteStream_h

#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

namespace nurbs
{
/// Values one after the other, as they lie in memory: both ends are the same program.
class Packer
{
public:
  template <typename T>
  void Put(const T& value)
  {
    static_assert(std::is_arithmetic<T>::value, "plain values only");
    this->PutBytes(&value, sizeof(T));
  }
  void PutText(const std::string& text)
  {
    this->Put<std::uint64_t>(text.size());
    this->PutBytes(text.data(), text.size());
  }
  /// A vector of values or of fixed-size Eigen vectors of doubles.
  template <typename T>
  void PutAll(const std::vector<T>& values)
  {
    this->Put<std::uint64_t>(values.size());
    this->PutBytes(values.data(), values.size() * sizeof(T));
  }
  std::string Bytes;

private:
  void PutBytes(const void* data, size_t size)
  {
    if (size > 0)
    {
      this->Bytes.append(static_cast<const char*>(data), size);
    }
  }
};

/// The reverse of Packer. A child that runs wild may send anything: sizes are checked.
class Unpacker
{
public:
  explicit Unpacker(const std::string& bytes)
    : Bytes(bytes)
  {
  }
  template <typename T>
  T Take()
  {
    T value = T();
    this->TakeBytes(&value, sizeof(T));
    return value;
  }
  std::string TakeText()
  {
    std::string text(this->TakeCount(1), '\0');
    this->TakeBytes(&text[0], text.size());
    return text;
  }
  template <typename T>
  void TakeAll(std::vector<T>& values)
  {
    values.resize(this->TakeCount(sizeof(T)));
    this->TakeBytes(values.data(), values.size() * sizeof(T));
  }
  /// A number of things of at least `size` bytes each, which have to be there.
  size_t TakeCount(size_t size)
  {
    const std::uint64_t count = this->Take<std::uint64_t>();
    this->Good = this->Good && count <= (this->Bytes.size() - this->At) / size;
    return this->Good ? static_cast<size_t>(count) : 0;
  }
  bool Good = true;

private:
  void TakeBytes(void* data, size_t size)
  {
    this->Good = this->Good && size <= this->Bytes.size() - this->At;
    if (this->Good && size > 0)
    {
      std::memcpy(data, this->Bytes.data() + this->At, size);
      this->At += size;
    }
  }
  const std::string& Bytes;
  size_t At = 0;
};
}

#endif
