// The kernels through OpenCL: compiled by the device's driver when it is opened, from the sources that stand in
// VEX_KERNEL_FOLDER.
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "tests/opencl/device.h"

namespace vex {
namespace {

void require(cl_int status, const char* what) {
  if (status != CL_SUCCESS) throw std::runtime_error(std::string("OpenCL: ") + what + ": " + std::to_string(status));
}

std::string source_of(const std::string& name) {
  std::ifstream file(std::string(VEX_KERNEL_FOLDER) + "/" + name);
  if (!file) throw std::runtime_error("no " + name + " in " VEX_KERNEL_FOLDER);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// What is released with `release` at the end; null at first.
template <class Handle, cl_int (*release)(Handle)>
class Owned {
 public:
  Owned() = default;
  explicit Owned(Handle handle) : handle_(handle) {}
  Owned(const Owned&) = delete;
  Owned(Owned&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
  Owned& operator=(Owned&& other) noexcept {
    std::swap(handle_, other.handle_);
    return *this;
  }
  ~Owned() {
    if (handle_ != nullptr) release(handle_);
  }
  const Handle& get() const { return handle_; }

 private:
  Handle handle_ = nullptr;
};
using Buffer = Owned<cl_mem, clReleaseMemObject>;
using Kernel = Owned<cl_kernel, clReleaseKernel>;

class OpenClDevice final : public Device {
 public:
  OpenClDevice(cl_device_id device, bool is_gpu) : device_(device), is_gpu_(is_gpu) {
    cl_int status = CL_SUCCESS;
    context_ = Context(clCreateContext(nullptr, 1, &device, nullptr, nullptr, &status));
    require(status, "no context");
    queue_ = Queue(clCreateCommandQueue(context_.get(), device, 0, &status));
    require(status, "no queue");
    const std::string texts[] = {source_of("pair.h"), source_of("draw.cl"), source_of("search.cl"),
                                 source_of("kernels.cl")};
    const char* sources[] = {texts[0].c_str(), texts[1].c_str(), texts[2].c_str(), texts[3].c_str()};
    program_ = Program(clCreateProgramWithSource(context_.get(), 4, sources, nullptr, &status));
    require(status, "no program");
    if (clBuildProgram(program_.get(), 1, &device, "-cl-std=CL1.2", nullptr, nullptr) != CL_SUCCESS) {
      std::string log(1 << 16, '\0');
      clGetProgramBuildInfo(program_.get(), device, CL_PROGRAM_BUILD_LOG, log.size(), log.data(), nullptr);
      throw std::runtime_error("OpenCL: the kernels are not compiled: " + std::string(log.c_str()));
    }
    draw_ = kernel("draw");
    decide_ = kernel("decide");
    poses_ = kernel("poses");
    answers_ = kernel("answers");
    pair_ = buffer(sizeof(VexPair));
    counts_ = buffer(4 * sizeof(cl_uint));
    listed_ = buffer(most_trials() * sizeof(cl_uint));
    open_ = buffer(most_trials() * sizeof(cl_uint));
  }

  std::string name() const override {
    std::string text(256, '\0');
    clGetDeviceInfo(device_, CL_DEVICE_NAME, text.size(), text.data(), nullptr);
    return "OpenCL on " + std::string(text.c_str());
  }

  void set_pair(const VexPair& pair) override { write(pair_, &pair, sizeof pair); }

  std::vector<double> poses(std::uint64_t seed, std::uint64_t first, std::uint32_t n) override {
    std::vector<double> columns(std::size_t{VEX_POSE_COLUMNS} * n);
    const Buffer at = buffer(columns.size() * sizeof(double));
    start(poses_, n, 0, pair_.get(), cl_ulong{seed}, cl_ulong{first}, cl_uint{n}, at.get());
    read(at, columns.data(), columns.size() * sizeof(double));
    return columns;
  }

  std::vector<int> answers(const std::vector<double>& columns, std::uint32_t n) override {
    std::vector<int> found(n);
    const Buffer from = buffer(columns.size() * sizeof(double)), at = buffer(n * sizeof(int));
    write(from, columns.data(), columns.size() * sizeof(double));
    start(answers_, n, 0, pair_.get(), cl_uint{n}, from.get(), at.get());
    read(at, found.data(), n * sizeof(int));
    return found;
  }

 protected:
  std::uint32_t most_trials() const override { return is_gpu_ ? 1u << 26 : 1u << 20; }

  Counts run_part(std::uint64_t seed, std::uint64_t first, std::uint32_t n, std::vector<std::uint32_t>& open) override {
    cl_uint counts[4] = {};
    write(counts_, counts, sizeof counts);
    const std::uint32_t n_groups = (n + VEX_MOST_IN_GROUP - 1) / VEX_MOST_IN_GROUP;
    start(draw_, std::size_t{n_groups} * kGroup, kGroup, pair_.get(), cl_ulong{seed}, cl_ulong{first}, cl_uint{n},
          cl_uint{VEX_MOST_IN_GROUP / kGroup}, listed_.get(), counts_.get());
    start(decide_, is_gpu_ ? kItemsOfGpu : kItemsOfCpu, kGroup, pair_.get(), cl_ulong{seed}, cl_ulong{first},
          listed_.get(), open_.get(), counts_.get());
    read(counts_, counts, sizeof counts);
    open.resize(counts[3]);
    if (!open.empty()) read(open_, open.data(), open.size() * sizeof(cl_uint));
    return {counts[0], counts[1], counts[2], counts[3]};
  }

 private:
  using Context = Owned<cl_context, clReleaseContext>;
  using Queue = Owned<cl_command_queue, clReleaseCommandQueue>;
  using Program = Owned<cl_program, clReleaseProgram>;

  static constexpr std::size_t kGroup = 128, kItemsOfGpu = 1u << 18, kItemsOfCpu = 1u << 12;

  Kernel kernel(const char* name) const {
    cl_int status = CL_SUCCESS;
    Kernel made(clCreateKernel(program_.get(), name, &status));
    require(status, name);
    return made;
  }
  Buffer buffer(std::size_t size) const {
    cl_int status = CL_SUCCESS;
    Buffer made(clCreateBuffer(context_.get(), CL_MEM_READ_WRITE, size, nullptr, &status));
    require(status, "no buffer");
    return made;
  }
  void write(const Buffer& to, const void* from, std::size_t size) const {
    require(clEnqueueWriteBuffer(queue_.get(), to.get(), CL_TRUE, 0, size, from, 0, nullptr, nullptr), "no write");
  }
  void read(const Buffer& from, void* to, std::size_t size) const {
    require(clEnqueueReadBuffer(queue_.get(), from.get(), CL_TRUE, 0, size, to, 0, nullptr, nullptr), "no read");
  }

  // `n` work items in groups of `group`, or as the device likes where that is 0.
  template <class... Arguments>
  void start(const Kernel& kernel, std::size_t n, std::size_t group, const Arguments&... arguments) const {
    cl_uint place = 0;
    (require(clSetKernelArg(kernel.get(), place++, sizeof arguments, &arguments), "no argument"), ...);
    require(clEnqueueNDRangeKernel(queue_.get(), kernel.get(), 1, nullptr, &n, group > 0 ? &group : nullptr, 0, nullptr,
                                   nullptr),
            "no start");
  }

  cl_device_id device_;
  bool is_gpu_;
  Context context_;
  Queue queue_;
  Program program_;
  Kernel draw_, decide_, poses_, answers_;
  Buffer pair_, counts_, listed_, open_;
};

}  // namespace

std::unique_ptr<Device> opencl_device() {
  cl_uint n_platforms = 0;
  if (clGetPlatformIDs(0, nullptr, &n_platforms) != CL_SUCCESS || n_platforms == 0) return nullptr;
  std::vector<cl_platform_id> platforms(n_platforms);
  require(clGetPlatformIDs(n_platforms, platforms.data(), nullptr), "no platforms");
  for (const cl_device_type type : {cl_device_type{CL_DEVICE_TYPE_GPU}, cl_device_type{CL_DEVICE_TYPE_ALL}}) {
    for (const cl_platform_id platform : platforms) {
      cl_uint n_devices = 0;
      if (clGetDeviceIDs(platform, type, 0, nullptr, &n_devices) != CL_SUCCESS || n_devices == 0) continue;
      std::vector<cl_device_id> devices(n_devices);
      require(clGetDeviceIDs(platform, type, n_devices, devices.data(), nullptr), "no devices");
      for (const cl_device_id device : devices) {
        cl_device_fp_config doubles = 0;
        clGetDeviceInfo(device, CL_DEVICE_DOUBLE_FP_CONFIG, sizeof doubles, &doubles, nullptr);
        if (doubles != 0) return std::make_unique<OpenClDevice>(device, type == CL_DEVICE_TYPE_GPU);
      }
    }
  }
  return nullptr;
}

}  // namespace vex
