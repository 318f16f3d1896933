// GL calls OSMesa by name: the library itself exports the functions of GL 3.
#define GL_GLEXT_PROTOTYPES

#include "stream/raster/osmesa_module.hpp"

#include <GL/osmesa.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <type_traits>

#include "io/error.hpp"

namespace atlasgauge {
namespace {

/// (2 / viewport) / 256 is a power of two and the sum needs 23 bits, so nothing is rounded.
constexpr const char* kVertexShader = R"(#version 450 core
layout(location = 0) in uvec2 place;
layout(location = 1) in uint rank;
flat out float chart;
const float kPerUnit = 2.0 / (256.0 * 16384.0);
void main() {
  gl_Position = vec4(vec2(place) * kPerUnit - 1.0, 0.0, 1.0);
  chart = float(rank);
}
)";
static_assert(OsmesaCanvas::kViewport == 16384);

constexpr const char* kFragmentShader = R"(#version 450 core
flat in float chart;
layout(location = 0) out float count;
layout(location = 1) out float highest;
layout(location = 2) out float lowest;
void main() {
  count = 1.0;
  highest = chart;
  lowest = chart;
}
)";

struct LayerRule {
  GLenum blend;
  float empty;
};

/// In the order of OsmesaCanvas::Layer.
constexpr std::array<LayerRule, 3> kLayers{{
    {GL_FUNC_ADD, 0},
    {GL_MAX, 0},
    {GL_MIN, OsmesaCanvas::kNoRank},
}};
constexpr GLsizei kLayerCount = kLayers.size();

[[noreturn]] void fail(const std::string& text) {
  throw Error(ErrorKind::kInternal, "OSMesa " + text + "; use the scalar raster instead");
}

/// `step` as in "draw triangles".
void check_gl(const std::string& step) {
  const GLenum error = glGetError();
  if (error == GL_NO_ERROR) return;
  if (error == GL_OUT_OF_MEMORY) {
    throw Error(ErrorKind::kResource, "memory is too little for OSMesa to " + step +
                                          "; use the scalar raster, or free some memory");
  }
  fail("failed to " + step + " (GL error " + std::to_string(error) + ")");
}

struct ContextEnd {
  void operator()(OSMesaContext context) const { OSMesaDestroyContext(context); }
};
using Context = std::unique_ptr<std::remove_pointer_t<OSMesaContext>, ContextEnd>;

Context make_context() {
  constexpr std::array<int, 9> kAttributes{OSMESA_FORMAT,
                                           OSMESA_RGBA,
                                           OSMESA_PROFILE,
                                           OSMESA_CORE_PROFILE,
                                           OSMESA_CONTEXT_MAJOR_VERSION,
                                           4,
                                           OSMESA_CONTEXT_MINOR_VERSION,
                                           5,
                                           0};
  Context context(OSMesaCreateContextAttribs(kAttributes.data(), nullptr));
  if (!context) fail("offers no core profile of OpenGL 4.5");
  return context;
}

/// While it lives, GL works for a context in this thread. None stays current beyond, for it could
/// be destroyed by another thread.
class Current {
 public:
  explicit Current(OSMesaContext context) {
    if (OSMesaMakeCurrent(context, picture_.data(), GL_UNSIGNED_BYTE, 1, 1) != GL_TRUE) {
      fail("cannot make a context current");
    }
  }
  ~Current() { OSMesaMakeCurrent(nullptr, nullptr, 0, 0, 0); }
  Current(const Current&) = delete;
  Current& operator=(const Current&) = delete;

 private:
  std::array<unsigned char, 4> picture_{};  // not drawn into, but OSMesa wants one
};

void attach_shader(GLuint program, GLenum kind, const char* source) {
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  glAttachShader(program, shader);
  glDeleteShader(shader);
}

void use_program() {
  const GLuint program = glCreateProgram();
  attach_shader(program, GL_VERTEX_SHADER, kVertexShader);
  attach_shader(program, GL_FRAGMENT_SHADER, kFragmentShader);
  glLinkProgram(program);
  GLint linked = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked == 0) {
    std::array<char, 512> log{};
    glGetProgramInfoLog(program, log.size() - 1, nullptr, log.data());
    fail(std::string("cannot link shaders: ") + log.data());
  }
  glUseProgram(program);
}

void use_corner_buffer() {
  GLuint vertices = 0;
  GLuint buffer = 0;
  glGenVertexArrays(1, &vertices);
  glBindVertexArray(vertices);
  glGenBuffers(1, &buffer);
  glBindBuffer(GL_ARRAY_BUFFER, buffer);
  glBindVertexBuffer(0, buffer, 0, sizeof(OsmesaCorner));
  const auto attribute = [](GLuint location, GLint numbers, GLuint offset) {
    glVertexAttribIFormat(location, numbers, GL_UNSIGNED_INT, offset);
    glVertexAttribBinding(location, 0);
    glEnableVertexAttribArray(location);
  };
  attribute(0, 2, offsetof(OsmesaCorner, x));
  attribute(1, 1, offsetof(OsmesaCorner, rank));
}

void use_blending() {
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE);
  for (GLuint layer = 0; layer < kLayerCount; ++layer) {
    glBlendEquationi(layer, kLayers[layer].blend);
  }
}

/// Pixels to the left of the picture and below it that are never drawn. llvmpipe cuts the box of a
/// triangle at pixel 0, and takes triangles whose box is then smaller than 16 pixels for small: it
/// computes their edges in 32 bits, too few for the tip of a large triangle.
constexpr std::int64_t kLead = 64;

struct PixelBox {
  explicit PixelBox(const TexelRect& picture)
      : x(static_cast<GLint>(kLead + picture.x0)),
        y(static_cast<GLint>(kLead + picture.y0)),
        width(static_cast<GLsizei>(picture.width())),
        height(static_cast<GLsizei>(picture.height())) {}

  GLint x, y;
  GLsizei width, height;
};

/// Scissors bound what is cleared and drawn.
void use_scissors(const PixelBox& box) {
  glEnable(GL_SCISSOR_TEST);
  glScissor(box.x, box.y, box.width, box.height);
}

void use_viewport(std::int64_t width, std::int64_t height) {
  glViewport(static_cast<GLint>(kLead - OsmesaCanvas::margin(width)),
             static_cast<GLint>(kLead - OsmesaCanvas::margin(height)), OsmesaCanvas::kViewport,
             OsmesaCanvas::kViewport);
}

class GlCanvas : public OsmesaCanvas {
 public:
  GlCanvas() : context_(make_context()) {
    const Current current(context_.get());
    use_program();
    use_corner_buffer();
    make_framebuffer();
    use_blending();
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    check_gl("set up a context");
  }

  // Objects of GL go with their context.

  void start(std::int64_t width, std::int64_t height, const TexelRect& box) override {
    const Current current(context_.get());
    if (width > width_ || height > height_) grow(width, height);
    use_viewport(width, height);
    use_scissors(PixelBox(box));
    for (GLint layer = 0; layer < kLayerCount; ++layer) {
      const std::array<float, 4> empty{kLayers[static_cast<std::size_t>(layer)].empty, 0, 0, 0};
      glClearBufferfv(GL_COLOR, layer, empty.data());
    }
  }

  /// What is drawn waits in memory until it is finished.
  void draw(std::span<const OsmesaCorner> corners) override {
    const Current current(context_.get());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(corners.size_bytes()), corners.data(),
                 GL_STREAM_DRAW);
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(corners.size()));
    glFinish();
    check_gl("draw triangles");
  }

  void read(Layer layer, const TexelRect& part, float* to) override {
    const Current current(context_.get());
    glReadBuffer(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(layer));
    const PixelBox box(part);
    glReadPixels(box.x, box.y, box.width, box.height, GL_RED, GL_FLOAT, to);
    check_gl("read what was drawn");
  }

 private:
  void make_framebuffer() {
    GLuint framebuffer = 0;
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glGenRenderbuffers(kLayerCount, layers_.data());
    std::array<GLenum, kLayerCount> targets{};
    for (GLuint layer = 0; layer < kLayerCount; ++layer) {
      targets[layer] = GL_COLOR_ATTACHMENT0 + layer;
      glBindRenderbuffer(GL_RENDERBUFFER, layers_[layer]);
      glFramebufferRenderbuffer(GL_FRAMEBUFFER, targets[layer], GL_RENDERBUFFER, layers_[layer]);
    }
    glDrawBuffers(kLayerCount, targets.data());
  }

  void grow(std::int64_t width, std::int64_t height) {
    width_ = std::max(width, width_);
    height_ = std::max(height, height_);
    for (const GLuint layer : layers_) {
      glBindRenderbuffer(GL_RENDERBUFFER, layer);
      glRenderbufferStorage(GL_RENDERBUFFER, GL_R32F, static_cast<GLsizei>(kLead + width_),
                            static_cast<GLsizei>(kLead + height_));
    }
    const std::string size = std::to_string(width_) + "x" + std::to_string(height_);
    check_gl("hold " + size + " pixels");
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
      fail("cannot draw into " + size + " pixels");
    }
  }

  Context context_;
  std::array<GLuint, kLayerCount> layers_{};
  std::int64_t width_ = 0, height_ = 0;
};

}  // namespace
}  // namespace atlasgauge

extern "C" __attribute__((visibility("default"))) atlasgauge::OsmesaCanvas*
atlasgauge_osmesa_canvas() {
  return new atlasgauge::GlCanvas();
}
