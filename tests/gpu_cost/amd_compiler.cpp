#include "tests/gpu_cost/amd_compiler.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <regex>
#include <vulkan/vulkan_raii.hpp>

#include "engine/core/error.h"

namespace rowland::gpu_cost {

namespace {

constexpr const char* kRemedy = "install it (Debian: mesa-vulkan-drivers)";

/// The loader's description of RADV.
std::filesystem::path driver_file() {
    for (const char* folder : {"/usr/share/vulkan/icd.d", "/usr/local/share/vulkan/icd.d", "/etc/vulkan/icd.d"}) {
        std::error_code missing;
        for (const auto& entry : std::filesystem::directory_iterator(folder, missing))
            if (entry.path().filename().string().starts_with("radeon_icd")) return entry.path();
    }
    fail_system("RADV", "no Vulkan driver of AMD's GPUs", kRemedy);
}

vk::raii::Instance make_instance(const vk::raii::Context& context) {
    const vk::ApplicationInfo application({}, 0, {}, 0, VK_API_VERSION_1_3);
    return {context, vk::InstanceCreateInfo({}, &application)};
}

vk::raii::Device make_device(const vk::raii::PhysicalDevice& gpu) {
    const float priority = 1.0F;
    const vk::DeviceQueueCreateInfo queue({}, 0, 1, &priority);
    const char* extension = VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME;
    vk::StructureChain<vk::DeviceCreateInfo, vk::PhysicalDeviceVulkan13Features,
                       vk::PhysicalDevicePipelineExecutablePropertiesFeaturesKHR>
        info;
    info.get<vk::DeviceCreateInfo>().setQueueCreateInfos(queue).setPEnabledExtensionNames(extension);
    info.get<vk::PhysicalDeviceVulkan13Features>().setDynamicRendering(VK_TRUE);
    info.get<vk::PhysicalDevicePipelineExecutablePropertiesFeaturesKHR>().setPipelineExecutableInfo(VK_TRUE);
    return {gpu, info.get<vk::DeviceCreateInfo>()};
}

vk::raii::DescriptorSetLayout make_set_layout(const vk::raii::Device& device) {
    std::vector<vk::DescriptorSetLayoutBinding> bindings;
    for (std::uint32_t i = 0; i < kBindings; ++i)
        bindings.emplace_back(i,
                              i < kFirstStorageBinding   ? vk::DescriptorType::eUniformBuffer
                              : i < kFirstTextureBinding ? vk::DescriptorType::eStorageBuffer
                              : i == kTexelBufferBinding ? vk::DescriptorType::eUniformTexelBuffer
                                                         : vk::DescriptorType::eCombinedImageSampler,
                              1, vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment);
    return {device, vk::DescriptorSetLayoutCreateInfo({}, bindings)};
}

/// As engine/render/shaders/vertex_input.glsl.
constexpr std::array kAttributes{vk::Format::eR32G32B32Sfloat,    vk::Format::eR32G32B32Sfloat,
                                 vk::Format::eR32G32B32A32Sfloat, vk::Format::eR32G32Sfloat,
                                 vk::Format::eR32G32Sfloat,       vk::Format::eR32G32B32A32Sfloat,
                                 vk::Format::eR16G16B16A16Uint,   vk::Format::eR32G32B32A32Sfloat};

/// The instructions of a listing that read memory lane by lane.
int count_fetches(const std::string& assembly) {
    static const std::regex fetch(R"(\b(image_(sample|load|gather|msaa_load)|t?buffer_load|global_load|flat_load))");
    return static_cast<int>(std::distance(std::sregex_iterator(assembly.begin(), assembly.end(), fetch), {}));
}

double value_of(const std::vector<vk::PipelineExecutableStatisticKHR>& statistics, const std::string& name) {
    for (const vk::PipelineExecutableStatisticKHR& statistic : statistics)
        if (name == statistic.name.data()) return static_cast<double>(statistic.value.u64);
    fail_system("RADV", "no statistic '" + name + "'", "use Mesa 22.3 or later");
}

}  // namespace

const std::vector<Generation>& generations() {
    static const std::vector<Generation> all{{"RDNA2", {"NAVI21"}}, {"RDNA3", {"GFX1100", "NAVI31"}}};
    return all;
}

struct AmdCompiler::State {
    vk::raii::Context context;
    vk::raii::Instance instance = make_instance(context);
    vk::raii::PhysicalDevice gpu = vk::raii::PhysicalDevices(instance).at(0);
    vk::raii::Device device = make_device(gpu);
    vk::raii::DescriptorSetLayout set_layout = make_set_layout(device);
    vk::raii::PipelineLayout layout{device, vk::PipelineLayoutCreateInfo({}, *set_layout)};
    std::string device_name = gpu.getProperties().deviceName;
    std::string driver_name = gpu.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>()
                                  .get<vk::PhysicalDeviceDriverProperties>()
                                  .driverInfo;

    vk::raii::Pipeline make_pipeline(const Spirv& spirv) const;
    std::string assembly(const vk::PipelineExecutableInfoKHR& executable) const;
    StageStatistics statistics(const vk::PipelineExecutableInfoKHR& executable) const;
};

vk::raii::Pipeline AmdCompiler::State::make_pipeline(const Spirv& spirv) const {
    const vk::raii::ShaderModule vertex(device, vk::ShaderModuleCreateInfo({}, spirv.vertex));
    const vk::raii::ShaderModule fragment(device, vk::ShaderModuleCreateInfo({}, spirv.fragment));
    const std::array stages{
        vk::PipelineShaderStageCreateInfo({}, vk::ShaderStageFlagBits::eVertex, *vertex, "main"),
        vk::PipelineShaderStageCreateInfo({}, vk::ShaderStageFlagBits::eFragment, *fragment, "main")};
    const vk::VertexInputBindingDescription binding(0, 64);
    std::vector<vk::VertexInputAttributeDescription> attributes;
    for (std::uint32_t i = 0; i < kAttributes.size(); ++i) attributes.emplace_back(i, 0, kAttributes[i], 4 * i);
    const vk::PipelineVertexInputStateCreateInfo input({}, binding, attributes);
    const vk::PipelineInputAssemblyStateCreateInfo assembly_state({}, vk::PrimitiveTopology::eTriangleList);
    const vk::Viewport viewport(0, 0, 1280, 720, 0, 1);
    const vk::Rect2D scissor({0, 0}, {1280, 720});
    const vk::PipelineViewportStateCreateInfo viewport_state({}, viewport, scissor);
    vk::PipelineRasterizationStateCreateInfo rasterisation;
    rasterisation.setCullMode(vk::CullModeFlagBits::eBack).setLineWidth(1);
    const vk::PipelineMultisampleStateCreateInfo samples({}, vk::SampleCountFlagBits::e4);
    const vk::PipelineDepthStencilStateCreateInfo depth({}, VK_TRUE, VK_TRUE, vk::CompareOp::eLess);
    vk::PipelineColorBlendAttachmentState written;
    written.setColorWriteMask(vk::FlagTraits<vk::ColorComponentFlagBits>::allFlags);
    const vk::PipelineColorBlendStateCreateInfo blend({}, VK_FALSE, {}, written);
    const vk::Format colour = vk::Format::eR16G16B16A16Sfloat;
    const vk::PipelineRenderingCreateInfo targets(0, colour, vk::Format::eD32Sfloat);
    const auto flags = vk::PipelineCreateFlagBits::eCaptureStatisticsKHR |
                       vk::PipelineCreateFlagBits::eCaptureInternalRepresentationsKHR;
    return {device, nullptr,
            vk::GraphicsPipelineCreateInfo(flags, stages, &input, &assembly_state, nullptr, &viewport_state,
                                           &rasterisation, &samples, &depth, &blend, nullptr, *layout)
                .setPNext(&targets)};
}

std::string AmdCompiler::State::assembly(const vk::PipelineExecutableInfoKHR& executable) const {
    // Through C's interface: the caller owns the texts' storage, which the C++ interface leaves empty.
    const auto function = device.getDispatcher()->vkGetPipelineExecutableInternalRepresentationsKHR;
    const auto& info = static_cast<const VkPipelineExecutableInfoKHR&>(executable);
    std::uint32_t count = 0;
    function(*device, &info, &count, nullptr);
    std::vector<VkPipelineExecutableInternalRepresentationKHR> texts(count,
                                                                     vk::PipelineExecutableInternalRepresentationKHR());
    function(*device, &info, &count, texts.data());
    std::vector<std::string> storage(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        storage[i].resize(texts[i].dataSize);
        texts[i].pData = storage[i].data();
    }
    function(*device, &info, &count, texts.data());
    for (std::uint32_t i = 0; i < count; ++i)
        if (std::string(texts[i].name) == "Assembly") return storage[i];
    fail_system("RADV", "no listing of the machine code", "use a Mesa that is built with LLVM");
}

StageStatistics AmdCompiler::State::statistics(const vk::PipelineExecutableInfoKHR& executable) const {
    const auto values = device.getPipelineExecutableStatisticsKHR(executable);
    return {.instructions = static_cast<int>(value_of(values, "Instructions")),
            .fetches = count_fetches(assembly(executable)),
            .vector_registers = static_cast<int>(value_of(values, "VGPRs")),
            .waves = static_cast<int>(value_of(values, "Subgroups per SIMD")),
            .inverse_throughput = value_of(values, "Inverse Throughput")};
}

AmdCompiler::AmdCompiler(const Generation& generation) {
    const std::string file = driver_file().string();
    ::setenv("VK_DRIVER_FILES", file.c_str(), 1);
    ::setenv("VK_ICD_FILENAMES", file.c_str(), 1);  // of loaders before 1.3.234
    std::string reason;
    for (const std::string& family : generation.families) {
        ::setenv("RADV_FORCE_FAMILY", family.c_str(), 1);
        try {
            state_ = std::make_unique<State>();
            return;
        } catch (const std::exception& error) {
            reason = error.what();  // another version of Mesa may know the next name
        }
    }
    fail_system("RADV", fmt::format("no device {} without a GPU ({})", fmt::join(generation.families, " or "), reason),
                "use Mesa 22.3 or later (Debian: mesa-vulkan-drivers)");
}

AmdCompiler::~AmdCompiler() = default;

const std::string& AmdCompiler::device() const {
    return state_->device_name;
}

const std::string& AmdCompiler::driver() const {
    return state_->driver_name;
}

PipelineStatistics AmdCompiler::compile(const Spirv& spirv) const {
    const vk::raii::Pipeline pipeline = state_->make_pipeline(spirv);
    PipelineStatistics result;
    const auto executables = state_->device.getPipelineExecutablePropertiesKHR(vk::PipelineInfoKHR(*pipeline));
    for (std::uint32_t i = 0; i < executables.size(); ++i) {
        const StageStatistics statistics = state_->statistics({*pipeline, i});
        if (executables[i].stages & vk::ShaderStageFlagBits::eVertex) result.vertex = statistics;
        if (executables[i].stages & vk::ShaderStageFlagBits::eFragment) result.fragment = statistics;
    }
    return result;
}

}  // namespace rowland::gpu_cost
