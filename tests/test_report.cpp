// The page and the picture as files. What a browser makes of the page is in tests/report_in_browser.py.
#include "polylab/report.h"

#include "polylab/initial_labeling.h"
#include "polylab/picture.h"
#include "shapes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <string>

using namespace polylab;

namespace {

std::string base64_of(const std::string& text) { return base64(std::vector<unsigned char>(text.begin(), text.end())); }

std::size_t count(const std::string& text, const std::string& word) {
    std::size_t n = 0;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) n++;
    return n;
}

std::uint32_t big_endian(const std::string& text, std::size_t at) {
    std::uint32_t n = 0;
    for (std::size_t i = 0; i < 4; i++) n = n << 8 | static_cast<unsigned char>(text[at + i]);
    return n;
}

// Bits in deflate's order, and the fixed code read back, so that the picture is checked by a decoder that is not its encoder.
class Inflater {
public:
    explicit Inflater(const std::string& bytes) : bytes_(bytes) {}

    std::string inflate() {
        REQUIRE(bit() == 1);   // last block
        REQUIRE(bit() == 1);   // of the fixed code
        REQUIRE(bit() == 0);
        std::string out;
        for (unsigned s = symbol(); s != 256; s = symbol()) {
            if (s < 256) {
                out += static_cast<char>(s);
                continue;
            }
            const bool known = s == 285 || (s >= 257 && s <= 264);
            REQUIRE(known);
            for (int i = 0; i < 5; i++) REQUIRE(bit() == 0);   // distance 1
            REQUIRE(!out.empty());
            out.append(s == 285 ? 258 : s - 254, out.back());
        }
        return out;
    }

private:
    unsigned bit() {
        REQUIRE(at_ / 8 < bytes_.size());
        const unsigned b = static_cast<unsigned char>(bytes_[at_ / 8]) >> at_ % 8 & 1;
        at_++;
        return b;
    }
    // RFC 1951, 3.2.6
    unsigned symbol() {
        unsigned code = 0;
        for (int i = 0; i < 7; i++) code = code << 1 | bit();
        if (code <= 0x17) return 256 + code;
        code = code << 1 | bit();
        if (code >= 0x30 && code <= 0xBF) return code - 0x30;
        if (code >= 0xC0 && code <= 0xC7) return 280 + code - 0xC0;
        code = code << 1 | bit();
        return 144 + code - 0x190;
    }

    const std::string& bytes_;
    std::size_t at_ = 0;
};

std::map<std::string, std::string> chunks_of(const std::string& png) {
    REQUIRE(png.substr(0, 8) == "\x89PNG\r\n\x1a\n");
    std::map<std::string, std::string> chunks;
    for (std::size_t at = 8; at < png.size();) {
        const std::size_t length = big_endian(png, at);
        chunks[png.substr(at + 4, 4)] = png.substr(at + 8, length);
        at += length + 12;
    }
    return chunks;
}

}   // namespace

TEST_CASE("report: a part is called by its file and folder") {
    CHECK(title_of("cube.obj") == "cube.obj");
    CHECK(title_of("/cube.obj") == "cube.obj");
    CHECK(title_of("B1/surface.obj") == "B1/surface.obj");
    CHECK(title_of("/parts/MAMBO/B1/surface.obj") == "B1/surface.obj");
    CHECK(title_of("parts\\B1\\surface.obj") == "B1\\surface.obj");
}

TEST_CASE("base64 gives the RFC's examples") {
    CHECK(base64_of("") == "");
    CHECK(base64_of("f") == "Zg==");
    CHECK(base64_of("fo") == "Zm8=");
    CHECK(base64_of("foo") == "Zm9v");
    CHECK(base64_of("foob") == "Zm9vYg==");
    CHECK(base64_of("fooba") == "Zm9vYmE=");
    CHECK(base64_of("foobar") == "Zm9vYmFy");
    CHECK(base64({0xfb, 0xff}) == "+/8=");
}

TEST_CASE("the page holds each layer once, needs no network, and no name breaks out of it") {
    const TriMesh mesh = build_mesh(shapes::cube(2));
    const Labeling labels = naive_labeling(mesh);
    Report report;
    report.title = "</script><b>&.obj @DATA@";
    report.parameters = {{"command", "label"}, {"--lock", "</script>"}};
    report.layers = {{"naive", labels}, {"final", labels}};
    const std::string page = report_html(mesh, report);
    CHECK(page == report_html(mesh, report));
    CHECK(page.substr(0, 15) == "<!DOCTYPE html>");
    CHECK(count(page, "</script>") == 2);   // the data's and the script's
    CHECK(page.find("<title>&lt;/script>&lt;b>&amp;.obj @DATA@ - polylab</title>") != std::string::npos);
    CHECK(page.find("\"--lock\": \"\\u003c/script>\"") != std::string::npos);
    CHECK(count(page, "\"labels\": {") == 2);
    CHECK(count(page, "://") == 0);
    CHECK(count(page, "\"polycube\": \"\"") == 1);
    std::vector<unsigned char> bytes(labels.begin(), labels.end());
    CHECK(count(page, "\"data\": \"" + base64(bytes) + "\"") == 4);   // a cube's charts have the numbers of their labels
    report.polycube = mesh.points;
    CHECK(count(report_html(mesh, report), "\"polycube\": \"\"") == 0);
}

TEST_CASE("a PNG of runs of every length is read back") {
    std::vector<unsigned char> pixels;
    for (int run = 1; run <= 300; run++) pixels.insert(pixels.end(), run, static_cast<unsigned char>(run * 37 % 256));
    while (pixels.size() % 50 != 0) pixels.push_back(200);
    const std::string png = png_text(pixels, 50, {1, 2, 3, 4, 5, 6});
    const auto chunks = chunks_of(png);
    CHECK(big_endian(chunks.at("IHDR"), 0) == 50);
    CHECK(big_endian(chunks.at("IHDR"), 4) == pixels.size() / 50);
    CHECK(chunks.at("PLTE") == "\1\2\3\4\5\6");
    const std::string stream = chunks.at("IDAT");
    CHECK(stream.substr(0, 2) == "\x78\x01");
    std::string expected;
    for (std::size_t i = 0; i < pixels.size(); i++) {
        if (i % 50 == 0) expected += '\0';
        expected += static_cast<char>(pixels[i]);
    }
    CHECK(Inflater(stream.substr(2)).inflate() == expected);
    CHECK(png.substr(png.size() - 8) == "IEND\xae\x42\x60\x82");   // the checksum of this chunk is known
}

TEST_CASE("the picture of a cube shows its three near sides, and background around it") {
    const TriMesh mesh = build_mesh(shapes::cube(2));
    const std::string png = png_picture(mesh, build_graph(mesh, naive_labeling(mesh)), 64);
    const std::string rows = Inflater(chunks_of(png).at("IDAT").substr(2)).inflate();
    REQUIRE(rows.size() == 64 * 65);
    std::map<int, int> pixels;   // -1 background, -2 border, else label
    for (std::size_t i = 0; i < rows.size(); i++)
        if (i % 65 != 0) pixels[rows[i] == 0 ? -1 : rows[i] == 1 ? -2 : (static_cast<unsigned char>(rows[i]) - 2) / 16]++;
    CHECK(pixels.size() == 5);
    for (const int shown : {-1, -2, 0, 2, 4}) CHECK(pixels[shown] > 100);
}
