#include "polylab/picture.h"

#include <algorithm>

namespace polylab {

namespace {

constexpr int kShades = 16;
// +X -X +Y -Y +Z -Z, then the stripes of invalid charts.
constexpr unsigned char kPaletteColour[kLabels + 1][3] = {{255, 0, 0}, {153, 0, 0}, {255, 255, 255}, {153, 153, 153},
                                                          {0, 0, 255}, {0, 0, 153}, {255, 31, 199}};
constexpr unsigned char kBackground = 0, kBorderIndex = 1, kFirstShade = 2;   // palette: then kShades per colour, dark to light

std::vector<unsigned char> make_palette() {
    std::vector<unsigned char> palette = {255, 255, 255, 24, 28, 34};
    for (const auto& colour : kPaletteColour)
        for (int shade = 0; shade < kShades; shade++)
            for (const unsigned char c : colour)
                palette.push_back(static_cast<unsigned char>(c * (60 * (kShades - 1) + 40 * shade) / (100 * (kShades - 1))));
    return palette;
}

// The facet that is nearest to the viewer at each pixel, kNone where there is none.
class DepthBuffer {
public:
    DepthBuffer(const TriMesh& mesh, int size) : size_(size), facet_(std::size_t(size) * size, kNone), depth_(facet_.size()) {
        project(mesh);
        for (Index f = 0; f < mesh.facets(); f++)
            draw(f, seen_[mesh.origin[3 * f]], seen_[mesh.origin[3 * f + 1]], seen_[mesh.origin[3 * f + 2]]);
    }

    Index at(int x, int y) const {
        return x < 0 || y < 0 || x >= size_ || y >= size_ ? kNone : facet_[std::size_t(y) * size_ + x];
    }
    static Vec3 toward_viewer() { return unit({1.4, 0.96, 0.82}); }

private:
    // x to the right and y down in pixels, z toward the viewer.
    void project(const TriMesh& mesh) {
        const Vec3 toward = toward_viewer(), right = unit({-toward.y, toward.x, 0}), up = cross(toward, right);
        for (const Vec3& p : mesh.points) seen_.push_back({dot(p, right), -dot(p, up), dot(p, toward)});
        Vec3 low = seen_[mesh.origin[0]], high = low;
        for (const Index v : mesh.origin)
            for (int a = 0; a < 3; a++) {
                low[a] = std::min(low[a], seen_[v][a]);
                high[a] = std::max(high[a], seen_[v][a]);
            }
        const double extent = std::max(high.x - low.x, high.y - low.y), scale = extent > 0 ? 0.94 * size_ / extent : 1;
        const Vec3 centre = (low + high) * 0.5, middle = {size_ / 2.0, size_ / 2.0, 0};
        for (Vec3& p : seen_) p = (p - centre) * scale + middle;
    }

    void draw(Index f, const Vec3& a, const Vec3& b, const Vec3& c) {
        const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        if (area == 0) return;
        const auto pixel = [&](double x) { return static_cast<int>(std::max(0.0, std::min(size_ - 1.0, x))); };
        const int x1 = pixel(std::max({a.x, b.x, c.x})), y1 = pixel(std::max({a.y, b.y, c.y}));
        for (int y = pixel(std::min({a.y, b.y, c.y})); y <= y1; y++)
            for (int x = pixel(std::min({a.x, b.x, c.x})); x <= x1; x++) {
                const double px = x + 0.5, py = y + 0.5;
                const double u = ((b.x - px) * (c.y - py) - (b.y - py) * (c.x - px)) / area;
                const double v = ((c.x - px) * (a.y - py) - (c.y - py) * (a.x - px)) / area;
                if (u < 0 || v < 0 || u + v > 1) continue;
                const double z = u * a.z + v * b.z + (1 - u - v) * c.z;
                const std::size_t i = std::size_t(y) * size_ + x;
                if (facet_[i] != kNone && depth_[i] >= z) continue;
                facet_[i] = f;
                depth_[i] = z;
            }
    }

    int size_;
    std::vector<Index> facet_;
    std::vector<double> depth_;
    std::vector<Vec3> seen_;   // vertex -> projected
};

// Bits of a deflate stream, the lowest of a byte first.
class Bits {
public:
    void put(unsigned value, int count) {
        for (int i = 0; i < count; i++) {
            if (used_ % 8 == 0) bytes_ += '\0';
            bytes_.back() = static_cast<char>(bytes_.back() | int(value >> i & 1u) << used_ % 8);
            used_++;
        }
    }
    // A symbol of deflate's fixed code (RFC 1951, 3.2.6); the highest bit of a code comes first.
    void symbol(unsigned s) {
        if (s < 144)
            code(0x30 + s, 8);
        else if (s < 256)
            code(0x190 + s - 144, 9);
        else if (s < 280)
            code(s - 256, 7);
        else
            code(0xC0 + s - 280, 8);
    }
    const std::string& bytes() const { return bytes_; }

private:
    void code(unsigned value, int count) {
        while (count-- > 0) put(value >> count & 1u, 1);
    }

    std::string bytes_;
    int used_ = 0;
};

// One block of the fixed code. A run of equal bytes is a byte and copies of the one before, 258 or 3 to 10 at a time: the
// lengths whose symbols have no extra bits.
std::string deflate_runs(const std::vector<unsigned char>& bytes) {
    Bits bits;
    bits.put(1, 1);   // last block
    bits.put(1, 2);   // fixed code
    for (std::size_t i = 0; i < bytes.size();) {
        std::size_t run = 0;
        while (i > 0 && i + run < bytes.size() && bytes[i + run] == bytes[i - 1] && run < 258) run++;
        if (run < 3) {
            bits.symbol(bytes[i++]);
            continue;
        }
        const std::size_t length = run == 258 ? 258 : std::min<std::size_t>(run, 10);
        bits.symbol(length == 258 ? 285 : static_cast<unsigned>(254 + length));
        bits.put(0, 5);   // distance 1
        i += length;
    }
    bits.symbol(256);
    return bits.bytes();
}

std::string big_endian(std::uint32_t n) {
    return {static_cast<char>(n >> 24), static_cast<char>(n >> 16), static_cast<char>(n >> 8), static_cast<char>(n)};
}

std::string chunk(const std::string& name, const std::string& content) {
    std::uint32_t crc = 0xFFFFFFFFu;
    for (const char c : name + content) {
        crc ^= static_cast<unsigned char>(c);
        for (int k = 0; k < 8; k++) crc = crc & 1 ? crc >> 1 ^ 0xEDB88320u : crc >> 1;
    }
    return big_endian(static_cast<std::uint32_t>(content.size())) + name + content + big_endian(~crc);
}

}   // namespace

std::string png_text(const std::vector<unsigned char>& pixels, int width, const std::vector<unsigned char>& palette) {
    const std::size_t height = pixels.size() / width;
    std::vector<unsigned char> rows;
    std::uint32_t a = 1, b = 0;   // Adler-32
    for (std::size_t y = 0; y < height; y++) {
        rows.push_back(0);   // no filter
        rows.insert(rows.end(), pixels.begin() + y * width, pixels.begin() + (y + 1) * width);
    }
    for (const unsigned char c : rows) {
        a = (a + c) % 65521;
        b = (b + a) % 65521;
    }
    const std::string header = big_endian(static_cast<std::uint32_t>(width)) + big_endian(static_cast<std::uint32_t>(height)) +
                               std::string("\x08\x03\0\0\0", 5);
    return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + chunk("PLTE", std::string(palette.begin(), palette.end())) +
           chunk("tRNS", std::string(1, '\0')) + chunk("IDAT", "\x78\x01" + deflate_runs(rows) + big_endian(b << 16 | a)) +
           chunk("IEND", "");
}

std::string png_picture(const TriMesh& mesh, const LabelingGraph& graph, int size) {
    const DepthBuffer buffer(mesh, size);
    const auto chart = [&](int x, int y) { return buffer.at(x, y) == kNone ? kNone : graph.chart[buffer.at(x, y)]; };
    std::vector<unsigned char> pixels;
    pixels.reserve(std::size_t(size) * size);
    for (int y = 0; y < size; y++)
        for (int x = 0; x < size; x++) {
            const Index c = chart(x, y);
            if (c == kNone) {
                pixels.push_back(kBackground);
            } else if (chart(x - 1, y) != c || chart(x + 1, y) != c || chart(x, y - 1) != c || chart(x, y + 1) != c) {
                pixels.push_back(kBorderIndex);
            } else {
                const bool stripe = !graph.charts[c].valid && (x + y) % 16 < 7;
                const int colour = stripe ? kLabels : graph.charts[c].label;
                const double slope = std::abs(dot(mesh.normal[buffer.at(x, y)], DepthBuffer::toward_viewer()));
                const int shade = std::min(kShades - 1, static_cast<int>(slope * kShades));
                pixels.push_back(static_cast<unsigned char>(kFirstShade + colour * kShades + shade));
            }
        }
    return png_text(pixels, size, make_palette());
}

}   // namespace polylab
