// Rasterises what is seen (film.h), computes ambient light at half the resolution (ambient.h), shades every sample,
// darkens the borders of pieces and caps, and averages the samples of a pixel. O(triangles + samples + ambient rays);
// 17 bytes a sample and 100 bytes per four pixels.

#include "segment/picture/picture.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"
#include "segment/picture/ambient.h"
#include "segment/picture/png.h"
#include "segment/picture/shade.h"

namespace qchopper {
namespace {

void check(std::span<const ColouredMesh> meshes, const PictureOptions& options) {
    const auto refuse = [](const std::string& why) { throw InputError(InputFault::use, "no picture: " + why); };
    const bool any = std::any_of(meshes.begin(), meshes.end(), [](const ColouredMesh& one) {
        return one.mesh != nullptr && !one.mesh->triangles.empty();
    });
    if (!any) refuse("there is no triangle to draw");
    if (options.width < 1 || options.width > 16384 || options.height < 1 || options.height > 16384) {
        refuse("width and height must be 1 to 16384 pixels");
    }
    if (options.supersampling < 1 || options.supersampling > 8) refuse("supersampling must be 1 to 8");
    if (options.ambient_rays < 0 || options.ambient_rays > 32) refuse("ambient rays must be 0 to 32");
    const double samples =
        static_cast<double>(options.width) * options.height * options.supersampling * options.supersampling;
    if (samples > 1.5e8) refuse("width x height x supersampling squared must not exceed 150 million");
    if (!(norm(options.view) > 0) || !std::isfinite(norm(options.view))) refuse("the view must have a direction");
    if (!std::isfinite(norm(options.up))) refuse("up must be finite");
    if (!(options.frame >= 0 && options.frame < 0.5)) refuse("the frame must be 0 to 0.5");
    if (!(options.letters > 0 && options.letters <= 0.2)) refuse("the letters must be above 0 and at most 0.2 high");
    if (!(options.outline >= 0 && options.outline <= 20)) refuse("the outline must be 0 to 20 pixels");
}

// What every sample sees.
std::vector<Region> regions_of(const Scene& scene, const Film& film) {
    std::vector<Region> regions(film.seen.size());
    parallel_ranges(0, film.seen.size(), 1 << 14, [&](std::size_t first, std::size_t end) {
        for (std::size_t i = first; i < end; ++i) {
            if (film.seen[i] == Film::nothing) continue;
            regions[i] = scene.region_of(Film::triangle(film.seen[i]));
        }
    });
    return regions;
}

class Developer {
 public:
    Developer(const Scene& scene, const Film& film, const Camera& camera, const PictureOptions& options,
              const AmbientLight& ambient)
        : scene_(scene),
          film_(film),
          camera_(camera),
          options_(options),
          ambient_(ambient),
          shader_(scene, camera),
          background_(to_linear(options.background)),
          regions_(regions_of(scene, film)),
          radius_(static_cast<int>(std::lround(options.outline * options.supersampling / 2))) {}

    Rgb pixel(std::size_t px, std::size_t py) const {
        const auto fine = static_cast<std::size_t>(options_.supersampling);
        if (is_of_one_triangle(px * fine, py * fine)) return pixel_of_triangle(px * fine, py * fine);
        Vec3 sum;
        bool is_empty = true;
        for (std::size_t y = py * fine; y < (py + 1) * fine; ++y) {
            for (std::size_t x = px * fine; x < (px + 1) * fine; ++x) {
                const bool is_drawn = film_.at(x, y) != Film::nothing;
                sum = sum + (is_drawn ? colour(x, y) : background_);
                is_empty = is_empty && !is_drawn;
            }
        }
        return is_empty ? options_.background : to_rgb(1.0 / static_cast<double>(fine * fine) * sum);
    }

    const std::vector<Region>& regions() const { return regions_; }

 private:
    // Whether all samples of the pixel that begins at a sample see the same triangle.
    bool is_of_one_triangle(std::size_t left, std::size_t top) const {
        const auto fine = static_cast<std::size_t>(options_.supersampling);
        const std::uint64_t first = film_.at(left, top);
        if (first == Film::nothing) return false;
        for (std::size_t y = top; y < top + fine; ++y) {
            for (std::size_t x = left; x < left + fine; ++x) {
                const std::uint64_t other = film_.at(x, y);
                if (other == Film::nothing || Film::triangle(other) != Film::triangle(first)) return false;
            }
        }
        return true;
    }

    // The light of a triangle hardly changes within a pixel: it is computed once, in the middle of the samples.
    Rgb pixel_of_triangle(std::size_t left, std::size_t top) const {
        const auto fine = static_cast<std::size_t>(options_.supersampling);
        Vec3 middle;
        double line = 0;
        for (std::size_t y = top; y < top + fine; ++y) {
            for (std::size_t x = left; x < left + fine; ++x) {
                middle = middle + seen_at(x, y);
                line += line_at(x, y);
            }
        }
        const double share = 1.0 / static_cast<double>(fine * fine);
        const std::uint32_t triangle = Film::triangle(film_.at(left, top));
        const SurfacePoint point = scene_.surface(triangle, share * middle, camera_.forward);
        const double light = ambient_.at(left + fine / 2, top + fine / 2, point);
        return to_rgb(share * line * shader_.colour(point, light));
    }

    Vec3 seen_at(std::size_t x, std::size_t y) const {
        return film_.start(camera_, x, y) + static_cast<double>(Film::depth(film_.at(x, y))) * camera_.forward;
    }

    Vec3 colour(std::size_t x, std::size_t y) const {
        const std::uint32_t triangle = Film::triangle(film_.at(x, y));
        const SurfacePoint point = scene_.surface(triangle, seen_at(x, y), camera_.forward);
        return line_at(x, y) * shader_.colour(point, ambient_.at(x, y, point));
    }

    // 1 inside, less where a border of the piece, or more faintly of a cap, runs within the radius.
    double line_at(std::size_t x, std::size_t y) const {
        const Region& here = regions_[y * film_.width + x];
        double keep = 1;
        for (int dy = -radius_; dy <= radius_; ++dy) {
            for (int dx = -radius_; dx <= radius_; ++dx) {
                if (dx * dx + dy * dy > radius_ * radius_) continue;
                const std::size_t nx = x + static_cast<std::size_t>(dx);  // wraps around below 0, and is too large then
                const std::size_t ny = y + static_cast<std::size_t>(dy);
                if (nx >= film_.width || ny >= film_.height) continue;
                const Region& there = regions_[ny * film_.width + nx];
                if (there.mesh != here.mesh) return 0.16;
                if (there.cap != here.cap) keep = 0.42;
            }
        }
        return radius_ > 0 ? keep : 1;
    }

    const Scene& scene_;
    const Film& film_;
    const Camera& camera_;
    const PictureOptions& options_;
    const AmbientLight& ambient_;
    Shader shader_;
    Vec3 background_;
    std::vector<Region> regions_;
    int radius_;  // of outlines, in samples
};

// Per mesh the pixel that lies deepest inside what is seen of it, by the distance along rows, columns and diagonals
// (Borgefors, "Distance transformations in digital images", 1986), on a grid of every `step`th sample.
struct LabelPlace {
    double x = 0;  // pixels
    double y = 0;
    int depth = 0;  // 0: the mesh is not seen
};

std::vector<LabelPlace> label_places(const std::vector<Region>& regions, const Film& film, std::size_t meshes,
                                     int supersampling) {
    const std::size_t step = 2 * static_cast<std::size_t>(supersampling);
    const std::size_t columns = film.width / step;
    const std::size_t rows = film.height / step;
    std::vector<int> depth(columns * rows, 0);
    const auto mesh_at = [&](std::size_t c, std::size_t r) {
        return regions[(r * step + step / 2) * film.width + c * step + step / 2].mesh;
    };
    const auto relax = [&](std::size_t c, std::size_t r, int dc, int dr, int cost) {
        const std::size_t nc = c + static_cast<std::size_t>(dc);
        const std::size_t nr = r + static_cast<std::size_t>(dr);
        const bool is_inside = nc < columns && nr < rows && mesh_at(nc, nr) == mesh_at(c, r);
        depth[r * columns + c] = std::min(depth[r * columns + c], cost + (is_inside ? depth[nr * columns + nc] : 0));
    };
    for (std::size_t r = 0; r < rows; ++r) {
        for (std::size_t c = 0; c < columns; ++c) {
            depth[r * columns + c] = std::numeric_limits<int>::max() / 2;
            relax(c, r, -1, 0, 3), relax(c, r, 0, -1, 3), relax(c, r, -1, -1, 4), relax(c, r, 1, -1, 4);
        }
    }
    std::vector<LabelPlace> places(meshes);
    for (std::size_t r = rows; r-- > 0;) {
        for (std::size_t c = columns; c-- > 0;) {
            relax(c, r, 1, 0, 3), relax(c, r, 0, 1, 3), relax(c, r, 1, 1, 4), relax(c, r, -1, 1, 4);
            const std::uint32_t mesh = mesh_at(c, r);
            if (mesh >= meshes || depth[r * columns + c] <= places[mesh].depth) continue;
            places[mesh] = {2.0 * static_cast<double>(c) + 1, 2.0 * static_cast<double>(r) + 1, depth[r * columns + c]};
        }
    }
    return places;
}

void draw_labels(Pixels& pixels, const Scene& scene, const Film& film, const std::vector<Region>& regions,
                 const Camera& camera, const PictureOptions& options) {
    const std::span<const ColouredMesh> meshes = scene.meshes();
    const std::vector<LabelPlace> places = label_places(regions, film, meshes.size(), options.supersampling);
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        if (places[i].depth > 0)
            draw_text(pixels, places[i].x, places[i].y, meshes[i].name, pixels.height * options.letters);
    }
    draw_scale_bar(pixels, camera.mm_per_pixel);
}

}  // namespace

Pixels render(const Scene& scene, const PictureOptions& options, const Context& context) {
    check(scene.meshes(), options);
    assert(scene.has_rays() || options.ambient_rays == 0);
    context.check_cancelled();
    const Camera camera = framed(scene.meshes(), options);
    const Film film = rasterised(scene.meshes(), camera, options);
    const auto height = static_cast<std::size_t>(options.height);
    std::size_t reported = 0;
    const auto report = [&](std::size_t rows) {
        context.check_cancelled();
        if (rows > reported) context.progress("rows drawn", reported = rows, height);
    };
    // Ambient light takes most of the time, so its rows are those that are counted; the last one waits for the rest.
    const AmbientLight ambient(scene, film, camera, options,
                               [&](std::size_t done, std::size_t all) { report((height - 1) * done / all); });
    const Developer developer(scene, film, camera, options, ambient);
    Pixels pixels{options.width, options.height, {}};
    pixels.rows.resize(static_cast<std::size_t>(options.width) * height);
    parallel_for(0, height, [&](std::size_t y) {
        const auto width = static_cast<std::size_t>(options.width);
        for (std::size_t x = 0; x < width; ++x) pixels.rows[y * width + x] = developer.pixel(x, y);
    });
    if (options.labels) draw_labels(pixels, scene, film, developer.regions(), camera, options);
    report(height);
    return pixels;
}

Bytes render_png(const Scene& scene, const PictureOptions& options, const Context& context) {
    return to_png(render(scene, options, context));
}

Bytes render_png(std::span<const ColouredMesh> meshes, const PictureOptions& options, const Context& context) {
    check(meshes, options);
    return render_png(Scene(meshes, options.ambient_rays > 0), options, context);
}

}  // namespace qchopper
