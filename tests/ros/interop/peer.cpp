// A roscpp node that the tests start: each mode does one thing and says what it sees, line by line.
#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <std_msgs/Int32.h>
#include <std_msgs/String.h>
#include <std_srvs/SetBool.h>

namespace
{
template <typename... Words>
void say(const Words&... words)
{
  std::ostringstream line;
  const char* gap = "";
  ((line << gap << words, gap = " "), ...);
  std::cout << line.str() << std::endl;
}

void wait_for_subscriber(const ros::Publisher& publisher)
{
  while (ros::ok() && publisher.getNumSubscribers() == 0)
    ros::WallDuration(0.01).sleep();
}

std_msgs::String text(const std::string& data)
{
  std_msgs::String message;
  message.data = data;
  return message;
}

void talk(ros::NodeHandle& node, int count, size_t size)
{
  ros::Publisher publisher = node.advertise<std_msgs::String>("chatter", count + 1);
  wait_for_subscriber(publisher);
  for (int number = 0; number < count; ++number)
    publisher.publish(text(std::to_string(number) + std::string(size, '.')));
  say("sent");
  ros::spin();
}

void talk_latched(ros::NodeHandle& node)
{
  ros::Publisher publisher = node.advertise<std_msgs::String>("chatter", 1, true);
  publisher.publish(text("first"));
  publisher.publish(text("second"));
  say("ready");
  ros::spin();
}

void talk_numbers(ros::NodeHandle& node)
{
  ros::Publisher publisher = node.advertise<std_msgs::Int32>("chatter", 1, true);
  publisher.publish(std_msgs::Int32());
  say("ready");
  ros::spin();
}

void hear(const std_msgs::String& message)
{
  const std::string& data = message.data;
  say(data.size() < 100 ? data : std::to_string(data.size()) + " bytes");
}

void listen(ros::NodeHandle& node)
{
  ros::Subscriber subscriber =
      node.subscribe("chatter", 10000, hear, ros::TransportHints().tcpNoDelay());
  say("ready");
  ros::spin();
}

bool flip(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response)
{
  response.success = true;
  response.message = "roscpp";
  return request.data;
}

void serve(ros::NodeHandle& node)
{
  ros::ServiceServer server = node.advertiseService("flip", flip);
  say("ready");
  ros::spin();
}

void call(ros::NodeHandle& node, bool persistent, int count)
{
  ros::service::waitForService("flip", 10000);
  ros::ServiceClient client = node.serviceClient<std_srvs::SetBool>("flip", persistent);
  int good = 0;
  std_srvs::SetBool asked;
  for (int number = 0; number < count; ++number)
  {
    asked.request.data = true;
    good += client.call(asked) && asked.response.success;
  }
  asked.request.data = false;
  const bool refused = !client.call(asked);
  say(good, asked.response.message, refused ? "refused" : "not refused");
}

void share(ros::NodeHandle& node)
{
  int whole = 0;
  double real = 0;
  std::string word;
  bool flag = false;
  std::vector<int> list;
  std::map<std::string, double> gains;
  node.getParam("/shared/whole", whole);
  node.getParam("/shared/real", real);
  node.getParam("/shared/word", word);
  node.getParam("/shared/flag", flag);
  node.getParam("/shared/list", list);
  node.getParam("/shared/gains", gains);
  say(whole, real, word, flag, list.size(), list.back(), gains["p"], node.hasParam("/shared/none"));
  std::string found;
  say(node.searchParam("gain", found), found);
  node.setParam("/theirs/list", std::vector<std::string>{"x", "y"});
  node.setParam("/theirs/real", 0.25);
  ros::param::set("~own", 7);
  node.deleteParam("/shared/word");
  int last = -1;
  while (ros::ok() && last != 0)
  {
    int value = last;
    if (ros::param::getCached("/followed", value) && value != last)
      say("followed", last = value);
    ros::WallDuration(0.01).sleep();
  }
}

void sleep_by_clock()
{
  say("ready");
  ros::Time::waitForValid();
  const ros::Time begin = ros::Time::now();
  ros::Duration(20.0).sleep();
  say((ros::Time::now() - begin).toSec() >= 20.0 ? "slept" : "woke early");
}

void tick(ros::NodeHandle& node)
{
  ros::Publisher publisher = node.advertise<rosgraph_msgs::Clock>("/clock", 10);
  wait_for_subscriber(publisher);
  for (int second = 100; ros::ok(); ++second)
  {
    rosgraph_msgs::Clock now;
    now.clock = ros::Time(second);
    publisher.publish(now);
    ros::WallDuration(0.01).sleep();
  }
}
}  // namespace

int main(int argc, char** argv)
{
  ros::init(argc, argv, "cpp");
  const std::string mode = argc > 1 ? argv[1] : "";
  const int number = argc > 2 ? std::stoi(argv[2]) : 0;
  ros::NodeHandle node;
  ros::AsyncSpinner spinner(1);
  if (mode == "share" || mode == "sleep" || mode == "tick")
    spinner.start();
  if (mode == "talk")
    talk(node, number, argc > 3 ? std::stoul(argv[3]) : 0);
  else if (mode == "talk-latched")
    talk_latched(node);
  else if (mode == "talk-numbers")
    talk_numbers(node);
  else if (mode == "listen")
    listen(node);
  else if (mode == "serve")
    serve(node);
  else if (mode == "call")
    call(node, false, number);
  else if (mode == "call-persistent")
    call(node, true, number);
  else if (mode == "share")
    share(node);
  else if (mode == "sleep")
    sleep_by_clock();
  else if (mode == "tick")
    tick(node);
  return 0;
}
