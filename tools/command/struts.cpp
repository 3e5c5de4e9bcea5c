// SPDX-License-Identifier: Apache-2.0
// msq struts: writes struts as a graph, or as a beam lattice.
#include <algorithm>

#include "output_file.h"
#include "scene.h"
#include "text.h"
#include "watch.h"

namespace command {

namespace {

msq_strut_graph_report collect(const Arguments& arguments, const Scene& scene, StrutGraph& graph) {
  auto def = defaults(msq_struts_def_init);
  take_box(arguments, scene.model.get(), def.min, def.max);
  // Struts of which a part is in the part, though their middle is not in its box.
  def.selection = MSQ_STRUTS_NEAR;
  if (!arguments.has("whole")) def.shape = scene.part.get();
  {
    Work work("collecting struts");
    check(msq_structure_strut_graph(scene.context.get(), scene.structure.get(), &def, graph.out(),
                                    work.job()));
  }
  msq_strut_graph_report report = {};
  report.struct_size = sizeof report;
  check(msq_strut_graph_info(graph.get(), &report));
  return report;
}

template <class T>
void append_list(std::string& text, const T* values, size_t count) {
  for (size_t i = 0; i < count; ++i) {
    if (i > 0) text += ',';
    if constexpr (std::is_same_v<T, double>) {
      append(text, values[i]);
    } else {
      text += std::to_string(+values[i]);
    }
  }
}

constexpr char HEADING[] =
    "strut,node_a,node_b,ax,ay,az,bx,by,bz,radius_a,radius_b,cut_a,cut_b,cell_i,cell_j,cell_k\n";

void write_csv(OutputFile& out, const msq_strut_graph_report& graph, Work& work) {
  out.write(HEADING);
  std::string row;
  for (uint64_t i = 0; i < graph.strut_count; ++i) {
    row.clear();
    append(row, i);
    row += ',';
    append_list(row, graph.struts + 2 * i, 2);
    for (const size_t end : {0, 1}) {
      row += ',';
      append_list(row, graph.nodes + 3 * size_t{graph.struts[2 * i + end]}, 3);
    }
    row += ',';
    append_list(row, graph.radii + 2 * i, 2);
    row += ',';
    append_list(row, graph.cuts + 2 * i, 2);
    row += ',';
    append_list(row, graph.cells + 3 * i, 3);
    row += '\n';
    out.write(row);
    work.set_share(static_cast<double>(i) / static_cast<double>(graph.strut_count));
    work.done(i + 1);
  }
}

void write_json(OutputFile& out, const msq_strut_graph_report& graph, Work& work) {
  const double total = static_cast<double>(graph.node_count + graph.strut_count);
  std::string row;
  for (uint64_t i = 0; i < graph.node_count; ++i) {
    row = "{\"node\":";
    append(row, i);
    row += ",\"at\":[";
    append_list(row, graph.nodes + 3 * i, 3);
    row += "]}\n";
    out.write(row);
    work.set_share(static_cast<double>(i) / total);
    work.done(0);
  }
  for (uint64_t i = 0; i < graph.strut_count; ++i) {
    row = "{\"strut\":";
    append(row, i);
    row += ",\"nodes\":[";
    append_list(row, graph.struts + 2 * i, 2);
    row += "],\"radii\":[";
    append_list(row, graph.radii + 2 * i, 2);
    row += "],\"cuts\":[";
    append_list(row, graph.cuts + 2 * i, 2);
    row += "],\"cell\":[";
    append_list(row, graph.cells + 3 * i, 3);
    row += "]}\n";
    out.write(row);
    work.set_share(static_cast<double>(graph.node_count + i) / total);
    work.done(i + 1);
  }
}

}  // namespace

void run_struts(const Arguments& arguments) {
  const std::string path = arguments.has("output") ? arguments.text("output") : "-";
  const std::string format = path == "-" ? ".csv" : ending(path);
  if (format != ".csv" && format != ".jsonl" && format != ".3mf") {
    arguments.refuse("output", "'" + path + "' ends in none of .csv, .jsonl, .3mf");
  }
  Scene scene = open_scene(arguments);
  if (scene.document) choose_structure(arguments, scene);
  if (!scene.structure) throw UsageError("msq struts needs --foam or --lattice");
  StrutGraph graph;
  const msq_strut_graph_report report = collect(arguments, scene, graph);
  if (format == ".3mf") {
    check_io(msq_io_beams_save(graph.get(), nullptr, path.c_str(), 1));
    return;
  }
  OutputFile out(path);
  {
    Work work("writing", "struts");
    if (format == ".csv") {
      write_csv(out, report, work);
    } else {
      write_json(out, report, work);
    }
  }
  out.commit();
}

}  // namespace command
